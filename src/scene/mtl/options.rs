//! Options of `map_*` statements.

use glam::Vec2;

use super::texture_map::TextureMap;
use crate::components::{Channel, Wrap};
use crate::scene::diagnostic::Tally;
use crate::scene::lines::Line;
use crate::scene::text;
use crate::scene::textures::MapUse;

/// The greatest number of an option, either way.
pub const MOST: f32 = 1e6;

/// What follows an option.
#[derive(Clone, Copy)]
enum Arguments {
    /// At most so many.
    Numbers(usize),
    /// `on` or `off`.
    Switch,
    /// One letter.
    Letter,
    Word,
}

/// All there are.
const OPTIONS: &[(&str, Arguments)] = &[
    ("-blendu", Arguments::Switch),
    ("-blendv", Arguments::Switch),
    ("-bm", Arguments::Numbers(1)),
    ("-boost", Arguments::Numbers(1)),
    ("-cc", Arguments::Switch),
    ("-clamp", Arguments::Switch),
    ("-imfchan", Arguments::Letter),
    ("-mm", Arguments::Numbers(2)),
    ("-o", Arguments::Numbers(3)),
    ("-s", Arguments::Numbers(3)),
    ("-t", Arguments::Numbers(3)),
    ("-texres", Arguments::Numbers(1)),
    ("-type", Arguments::Word),
];

/// An option as it is written, and its arguments.
#[derive(Debug)]
pub struct Given<'a> {
    option: &'a str,
    arguments: Vec<&'a str>,
}

/// The options at the start of a text, and what follows. Before a file's name, the last word of the text is no number of an option.
pub fn split(text: &str, before_name: bool) -> (Vec<Given<'_>>, &str) {
    let mut list = Vec::new();
    let mut rest = text.trim();
    while let Some((option, arguments)) = first_word(rest).and_then(|word| Some((word, arguments(word)?))) {
        rest = rest[option.len()..].trim_start();
        let most = if let Arguments::Numbers(most) = arguments { most } else { 1 };
        let mut taken = Vec::new();
        while let Some(word) = first_word(rest).filter(|_| taken.len() < most) {
            let fits = match arguments {
                Arguments::Numbers(_) => text::number(word).is_some(),
                Arguments::Switch => is_on(word).is_some(),
                Arguments::Letter => word.len() == 1,
                Arguments::Word => true,
            };
            if !fits || before_name && !taken.is_empty() && word.len() == rest.len() {
                break;
            }
            taken.push(word);
            rest = rest[word.len()..].trim_start();
        }
        list.push(Given { option, arguments: taken });
    }
    (list, rest)
}

/// Where the options behind a name begin, if nothing but options follows there, or a comment.
pub fn behind(text: &str) -> Option<usize> {
    let starts = text.match_indices(" -").chain(text.match_indices("\t-")).map(|(at, _)| at + 1);
    let is_end = |at: &usize| {
        let (options, rest) = split(&text[*at..], false);
        !options.is_empty() && (rest.is_empty() || rest.starts_with('#'))
    };
    starts.filter(is_end).min()
}

fn first_word(text: &str) -> Option<&str> {
    text.split_whitespace().next()
}

fn arguments(option: &str) -> Option<Arguments> {
    OPTIONS.iter().find(|(name, _)| name.eq_ignore_ascii_case(option)).map(|(_, arguments)| *arguments)
}

/// What a switch says.
fn is_on(word: &str) -> Option<bool> {
    match word.to_ascii_lowercase().as_str() {
        "on" => Some(true),
        "off" => Some(false),
        _ => None,
    }
}

/// Where an option stands, and for what.
pub struct Context<'a> {
    pub line: &'a Line,
    /// The statement as it is written.
    pub key: &'a str,
    pub used: MapUse,
}

impl Context<'_> {
    /// Writes an option into a map, or tells why it isn't honoured.
    pub fn apply(&self, given: &Given, map: &mut TextureMap, tally: &mut Tally) {
        let option = given.option;
        if option.eq_ignore_ascii_case("-texres") {
            let message = format!("`{option}` is not honoured in this whole file: pictures keep their size");
            return tally.once("-texres", || self.line.warning(option, message));
        }
        if let Some(why) = self.write(given, map, tally) {
            tally.push("map options", || self.line.warning(option, format!("`{option}` of `{}` {why}", self.key)));
        }
    }

    /// Writes an option into a map; else why not.
    fn write(&self, given: &Given, map: &mut TextureMap, tally: &mut Tally) -> Option<&'static str> {
        let Some(first) = given.arguments.first() else { return Some("has no value that fits: it is left out") };
        let on = is_on(first);
        match given.option.to_ascii_lowercase().as_str() {
            "-s" => map.scale = Vec2::from(self.numbers(given, [1.0; 2], tally)),
            "-o" => map.offset = Vec2::from(self.numbers(given, [0.0; 2], tally)),
            "-t" if given.arguments.iter().any(|word| text::number(word) != Some(0.0)) => {
                return Some("(turbulence) is not honoured: the map is looked up without it");
            }
            "-t" => {}
            "-mm" => {
                let [base, gain] = self.numbers(given, [0.0, 1.0], tally);
                if matches!(self.used, MapUse::Colour | MapUse::Number) {
                    (map.base, map.gain) = (base, gain);
                } else if (base, gain) != (0.0, 1.0) {
                    return Some("is not honoured: directions and heights are taken as they are");
                }
            }
            "-bm" => {
                let [bump, _] = self.numbers(given, [1.0; 2], tally);
                match self.used {
                    MapUse::Bump => map.bump = bump,
                    MapUse::Normal if bump == 1.0 => {}
                    MapUse::Normal => return Some("is not honoured: directions are taken as they are"),
                    MapUse::Colour | MapUse::Number => return Some("is left out: it is an option of `bump`"),
                }
            }
            "-clamp" => map.wrap = [if on == Some(true) { Wrap::Clamp } else { Wrap::Repeat }; 2],
            "-imfchan" => match (channel(first), self.used) {
                (Some(channel), MapUse::Number | MapUse::Bump) => map.channel = Some(channel),
                (Some(_), _) => return Some("is left out: it chooses one number, and this map is of three"),
                (None, _) => return Some("is not honoured: channels are r, g, b, m (alpha) and l (luminance)"),
            },
            "-blendu" | "-blendv" if on == Some(false) => {
                return Some("is not honoured: textures are filtered along both axes");
            }
            "-blendu" | "-blendv" => {}
            "-cc" if on == Some(true) => return Some("is not honoured: colours are taken as they are"),
            "-cc" => {}
            "-boost" => return Some("is not honoured: textures are not sharpened"),
            // The last one, `-type`.
            _ => return Some("is not honoured: it is an option of `refl`"),
        }
        None
    }

    /// The first two numbers of an option; those that are not given, or are none, have their defaults.
    fn numbers(&self, given: &Given, defaults: [f32; 2], tally: &mut Tally) -> [f32; 2] {
        let mut values = defaults;
        for ((value, default), word) in values.iter_mut().zip(defaults).zip(&given.arguments) {
            match text::number(word).filter(|number| number.is_finite()) {
                Some(number) if number.abs() <= f64::from(MOST) => *value = number as f32,
                _ => tally.push("map options", || {
                    let (option, key) = (given.option, self.key);
                    let message =
                        format!("`{option}` of `{key}` goes from -{MOST} to {MOST}: `{word}` is taken as {default}");
                    self.line.warning(word, message)
                }),
            }
        }
        values
    }
}

/// The channel of a letter.
fn channel(letter: &str) -> Option<Channel> {
    Some(match letter.to_ascii_lowercase().as_str() {
        "r" => Channel::Red,
        "g" => Channel::Green,
        "b" => Channel::Blue,
        "m" => Channel::Alpha,
        "l" => Channel::Luminance,
        _ => return None,
    })
}
