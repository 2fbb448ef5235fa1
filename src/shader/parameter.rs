//! A number that a module leaves to whoever draws: `@range(0.0, 16.0) override NAME: f32 = 8.0;`.
//!
//! `@range` is the linker's own; WGSL has `override` alone. The declaration is read here, and a linked text has a word of the
//! pass's parameters in its place (`values`): another value is no other code.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use naga::keywords::wgsl;

use super::error::{ErrorKind, Place, ShaderError, Source};
use super::token::Token;

/// What to do about a declaration that is wrong.
pub const EXAMPLE: &str = "write it like `@range(0.0, 16.0) override NAME: f32 = 8.0;`";

/// A declared parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Unlike that of every other parameter of the library.
    pub name: String,
    pub kind: ParameterKind,
    /// A value that fits.
    pub default: f64,
    /// The least and the most that it may be; none where any number of its kind will do.
    pub range: Option<[f64; 2]>,
    /// Of the name, where it is declared.
    pub place: Place,
}

/// The type of a [`Parameter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// `f32`
    Number,
    /// `u32`
    Whole,
    /// `i32`
    Signed,
    /// `bool`: 0 or 1.
    Switch,
}

impl ParameterKind {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "f32" => Self::Number,
            "u32" => Self::Whole,
            "i32" => Self::Signed,
            "bool" => Self::Switch,
            _ => return None,
        })
    }

    /// As WGSL writes it.
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::Number => "f32",
            Self::Whole => "u32",
            Self::Signed => "i32",
            Self::Switch => "bool",
        }
    }

    /// Whether a number can be a value of it.
    fn holds(self, value: f64) -> bool {
        let whole = |least: f64, most: f64| value.fract() == 0.0 && (least..=most).contains(&value);
        match self {
            Self::Number => (value as f32).is_finite(),
            Self::Whole => whole(0.0, u32::MAX.into()),
            Self::Signed => whole(i32::MIN.into(), i32::MAX.into()),
            Self::Switch => whole(0.0, 1.0),
        }
    }

    /// What can be a value of it, in words.
    fn wanted(self) -> &'static str {
        match self {
            Self::Number => "a number",
            Self::Whole => "a whole number, at least 0",
            Self::Signed => "a whole number",
            Self::Switch => "true or false",
        }
    }
}

impl Parameter {
    /// Whether a number can be its value.
    pub fn fits(&self, value: f64) -> bool {
        let within = self.range.is_none_or(|[least, most]| (least..=most).contains(&value));
        self.kind.holds(value) && within
    }

    /// Its value where it is set to something: that if it fits, else the default.
    pub fn value(&self, set: Option<f64>) -> f64 {
        set.filter(|value| self.fits(*value)).unwrap_or(self.default)
    }

    /// The bits of a value that fits, as the linked text reads them.
    pub fn word(&self, value: f64) -> u32 {
        match self.kind {
            ParameterKind::Number => (value as f32).to_bits(),
            ParameterKind::Signed => (value as i32) as u32,
            ParameterKind::Whole | ParameterKind::Switch => value as u32,
        }
    }

    /// What its value may be, in words.
    pub fn wanted(&self) -> String {
        match (self.kind, self.range) {
            (ParameterKind::Number, Some([least, most])) => format!("a number from {least} to {most}"),
            (_, Some([least, most])) => format!("a whole number from {least} to {most}"),
            (kind, None) => kind.wanted().to_owned(),
        }
    }
}

impl fmt::Display for Parameter {
    /// As it is declared.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some([least, most]) = self.range {
            write!(f, "@range({least}, {most}) ")?;
        }
        let kind = self.kind.wgsl();
        match self.kind {
            ParameterKind::Switch => write!(f, "override {}: {kind} = {};", self.name, self.default != 0.0),
            _ => write!(f, "override {}: {kind} = {};", self.name, self.default),
        }
    }
}

/// The parameter whose declaration starts at a token, at `@range` or `override`, and the token behind it.
pub fn read(source: &Arc<Source>, tokens: &[Token], at: usize) -> Result<(Parameter, usize), ShaderError> {
    Declaration { source, tokens }.read(at)
}

/// The parameters of a module, whatever features they stand under; none of a text that is no module.
pub fn all_of(source: &Arc<Source>, tokens: &[Token]) -> Result<Vec<Parameter>, ShaderError> {
    let declaration = Declaration { source, tokens };
    let (mut found, mut at, mut depth) = (Vec::new(), 0, 0);
    while at < tokens.len() {
        match declaration.text(at) {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            "@" | "override" if depth == 0 && declaration.starts(at) => {
                let (parameter, end) = declaration.read(at)?;
                found.push(parameter);
                at = end;
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    Ok(found)
}

/// Whether a name is one of WGSL's own: a word of the language, a type or function that is there already, or what it leaves to nobody.
fn is_taken(name: &str) -> bool {
    let words = [wgsl::RESERVED, wgsl::BUILTIN_IDENTIFIERS];
    name == "_" || name.starts_with("__") || words.iter().any(|words| words.contains(&name))
}

/// Whether a declaration starts at a token of a module's top level.
pub fn starts(source: &Arc<Source>, tokens: &[Token], at: usize) -> bool {
    Declaration { source, tokens }.starts(at)
}

/// The tokens of a module, of which a declaration is some.
struct Declaration<'a> {
    source: &'a Arc<Source>,
    tokens: &'a [Token],
}

impl<'a> Declaration<'a> {
    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| &self.source.text[token.range.clone()])
    }

    fn range(&self, at: usize) -> Range<usize> {
        let end = self.source.text.len();
        self.tokens.get(at).map_or(end..end, |token| token.range.clone())
    }

    fn starts(&self, at: usize) -> bool {
        self.text(at) == "override" || self.text(at) == "@" && self.text(at + 1) == "range"
    }

    fn error(&self, range: Range<usize>, message: impl Into<String>) -> ShaderError {
        ShaderError::at(ErrorKind::Parameter, self.source, range, message).help(EXAMPLE)
    }

    fn read(&self, at: usize) -> Result<(Parameter, usize), ShaderError> {
        let (bounds, at) = match self.text(at) {
            "@" => self.bounds(at)?,
            _ => (None, at),
        };
        if self.text(at) != "override" {
            return Err(
                self.error(self.range(at), "`@range` stands before an `override`, and nothing else between them")
            );
        }
        let named = self.range(at + 1);
        let name = self.text(at + 1).to_owned();
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            return Err(self.error(named, "`override` wants a name here"));
        }
        if is_taken(&name) {
            let message = format!("`{name}` is a word of WGSL: a parameter wants another name");
            return Err(self.error(named, message));
        }
        let (colon, kind) = (self.text(at + 2), self.text(at + 3));
        let kind = ParameterKind::of(kind).filter(|_| colon == ":" && self.text(at + 4) == "=");
        let Some(kind) = kind else {
            let message =
                format!("`{name}` wants a type and a default: f32, u32, i32 or bool, and a number or true or false");
            return Err(self.error(self.range(at + 2), message));
        };
        let (default, end) = self.until(at + 5, ";");
        let default_at = self.slice(at + 5, end);
        let wrong = |range: Range<usize>, what: &str, wanted: String| {
            let found = &self.source.text[range.clone()];
            self.error(range, format!("{what} of `{name}` is `{found}`: it wants {wanted}"))
        };
        let range = match bounds {
            Some(_) if kind == ParameterKind::Switch => {
                return Err(self.error(named, format!("`{name}` is true or false: it has no `@range`")));
            }
            Some(Bounds { values, places }) => {
                for (value, place) in values.into_iter().zip(places) {
                    if !kind.holds(value) {
                        return Err(wrong(place, "a bound", kind.wanted().to_owned()));
                    }
                }
                Some(values)
            }
            None => None,
        };
        let place = Place::new(self.source.clone(), named);
        let parameter = Parameter { name: name.clone(), kind, default: 0.0, range, place };
        let value = number(default, kind);
        match value.filter(|value| parameter.fits(*value)) {
            Some(default) => Ok((Parameter { default, ..parameter }, end + 1)),
            None => Err(wrong(default_at, "the default", parameter.wanted())),
        }
    }

    /// `@range(least, most)` at a token, and the token behind it.
    fn bounds(&self, at: usize) -> Result<(Option<Bounds>, usize), ShaderError> {
        if self.text(at + 2) != "(" {
            return Err(self.error(self.range(at + 1), "`@range` wants two numbers in parentheses"));
        }
        let (least, comma) = self.until(at + 3, ",");
        let (most, close) = self.until(comma + 1, ")");
        for (at, sign) in [(comma, ","), (close, ")")] {
            if self.text(at) != sign {
                let message = format!("`@range` wants two numbers, the least and the most: here a `{sign}`");
                return Err(self.error(self.range(at), message));
            }
        }
        let places = [self.slice(at + 3, comma), self.slice(comma + 1, close)];
        let read = |text: &str, place: &Range<usize>| {
            number(text, ParameterKind::Number)
                .ok_or_else(|| self.error(place.clone(), "`@range` wants two numbers, the least and the most"))
        };
        let values = [read(least, &places[0])?, read(most, &places[1])?];
        if values[0] >= values[1] {
            let message = format!("`@range` wants the least first, and more behind it: found {least} and {most}");
            return Err(self.error(places[0].start..places[1].end, message));
        }
        Ok((Some(Bounds { values, places }), close + 1))
    }

    /// The text from a token to the sign that ends it, and where that is.
    fn until(&self, at: usize, sign: &str) -> (&'a str, usize) {
        let ends = |i: &usize| [sign, ";", "{", "}", ")"].contains(&self.text(*i));
        let end = (at..self.tokens.len()).find(ends).unwrap_or(self.tokens.len());
        (&self.source.text[self.slice(at, end)], end)
    }

    /// The bytes from a token to the last before another; those of the other where there is none between.
    fn slice(&self, at: usize, end: usize) -> Range<usize> {
        if at < end { self.range(at).start..self.range(end - 1).end } else { self.range(end) }
    }
}

/// What stands in `@range`.
struct Bounds {
    values: [f64; 2],
    places: [Range<usize>; 2],
}

/// A literal of WGSL as a number, if its suffix is one of the kind.
fn number(text: &str, kind: ParameterKind) -> Option<f64> {
    if kind == ParameterKind::Switch {
        return text.parse::<bool>().ok().map(|on| f64::from(u8::from(on)));
    }
    let suffix = match kind {
        ParameterKind::Number => 'f',
        ParameterKind::Whole => 'u',
        ParameterKind::Signed | ParameterKind::Switch => 'i',
    };
    let digits = text.strip_suffix(suffix).unwrap_or(text);
    let plain = digits.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    digits.parse().ok().filter(|value: &f64| plain && value.is_finite())
}
