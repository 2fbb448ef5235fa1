//! Numbers of MTL statements.

use glam::Vec3;

use crate::scene::diagnostic::Tally;
use crate::scene::lines::{Line, words};
use crate::scene::text;

/// What a colour that is left out warns as.
const LEFT_OUT: &str = "numbers that are left out";

/// Reflectances from here to 255 are bytes: nothing reflects so much.
const BYTES: f32 = 16.0;

/// A reflectance: a colour, with a warning where it looks like bytes. It is taken as written all the same.
pub fn reflectance(line: &Line, key: &str, rest: &str, max: f32, tally: &mut Tally) -> Option<Vec3> {
    let colour = colour(line, key, rest, max, tally)?;
    if (BYTES..=255.0).contains(&colour.max_element()) {
        tally.push("colours in bytes", || {
            let channels = colour.to_array();
            let written = channels.map(|c| c.to_string()).join(" ");
            let meant = channels.map(|c| ((c / 255.0 * 1000.0).round() / 1000.0).to_string()).join(" ");
            line.warning(
                key,
                format!("`{key} {written}` looks like bytes, where 0 to 1 is meant; it is taken as written"),
            )
            .help(format!("did you mean `{key} {meant}`?"))
        });
    }
    Some(colour)
}

/// A colour: three values, or one for grey, each from 0 to `max`. Anything else is a warning, and `None`.
pub fn colour(line: &Line, key: &str, rest: &str, max: f32, tally: &mut Tally) -> Option<Vec3> {
    let mut list = words(rest).peekable();
    if let Some(kind) = list.next_if(|word| matches!(*word, "spectral" | "xyz")) {
        tally.push(LEFT_OUT, || {
            let what = if kind == "xyz" { "CIE XYZ colours are" } else { "spectral curves are" };
            let message = format!("{what} not supported: this `{key}` is left out");
            line.warning(kind, message).help(format!("write it as linear RGB: `{key} r g b`"))
        });
        return None;
    }
    let mut values = [0.0; 3];
    let mut count = 0;
    for word in list.by_ref().take(3) {
        values[count] = number(line, key, word, 0.0, max, tally)?;
        count += 1;
    }
    if let Some(extra) = list.next() {
        tally.push(LEFT_OUT, || {
            line.warning(extra, format!("`{key}` has three values: `{extra}` and what follows is left out"))
        });
    }
    match count {
        3 => Some(Vec3::from_array(values)),
        1 => Some(Vec3::splat(values[0])),
        _ => {
            tally.push(LEFT_OUT, || {
                let message = format!("`{key}` needs three values, or one for grey, and has {count}: it is left out");
                line.warning(key, message)
            });
            None
        }
    }
}

/// One number from `min` to `max`. A greater one becomes `max` and a smaller one `min`, each with a warning.
pub fn scalar(line: &Line, key: &str, rest: &str, min: f32, max: f32, tally: &mut Tally) -> Option<f32> {
    let mut list = words(rest);
    let Some(word) = list.next() else {
        tally.push(LEFT_OUT, || line.warning(key, format!("`{key}` needs a value and has none: it is left out")));
        return None;
    };
    if let Some(extra) = list.next() {
        tally.push(LEFT_OUT, || {
            line.warning(extra, format!("`{key}` has one value: `{extra}` and what follows is left out"))
        });
    }
    number(line, key, word, min, max, tally)
}

/// A whole number from 0 to `max`: of an illumination model, which are all there are.
pub fn whole(line: &Line, key: &str, rest: &str, max: u32, tally: &mut Tally) -> Option<u32> {
    let word = words(rest).next().unwrap_or_default();
    let value = word.parse::<u32>().ok().filter(|value| *value <= max);
    if value.is_none() {
        tally.push("illumination models", || {
            line.warning(key, format!("`{key}` is a whole number from 0 to {max}, not `{word}`: it is left out"))
        });
    }
    value
}

/// One finite number; out of range it is moved into it, with a warning.
fn number(line: &Line, key: &str, word: &str, min: f32, max: f32, tally: &mut Tally) -> Option<f32> {
    match text::number(word) {
        Some(value) if value.is_finite() => {
            let moved = value.clamp(f64::from(min), f64::from(max));
            if moved != value {
                tally.push("numbers out of range", || {
                    line.warning(word, format!("`{key}` goes from {min} to {max}: `{word}` is taken as {moved}"))
                });
            }
            Some(moved as f32)
        }
        _ => {
            tally.push(LEFT_OUT, || {
                line.warning(word, format!("`{word}` is not a finite number: this `{key}` is left out"))
            });
            None
        }
    }
}
