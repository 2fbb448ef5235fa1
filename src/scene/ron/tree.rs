//! The tree of a RON text.

use std::borrow::Cow;
use std::fmt;

use ron::value::RawValue;
use serde::Deserialize;
use serde::de::{self, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::scene::diagnostic::Diagnostic;
use crate::scene::text::Text;

/// Levels that a tree may have: scene files need eight, and ron reads a text once a level.
pub const MAX_DEPTH: usize = 24;

/// A value and where it stands.
#[derive(Clone, Debug)]
pub struct Node<'a> {
    /// The text that `source` is a slice of.
    pub text: &'a Text,
    /// The value as written.
    pub source: &'a str,
    pub kind: Kind<'a>,
}

/// What a value is made of.
#[derive(Clone, Debug)]
pub enum Kind<'a> {
    /// `(name: value, ..)`, `{ "name": value, .. }` or `{ 7: value, .. }`: name, its slice of the text, value.
    Fields(Vec<(String, &'a str, Node<'a>)>),
    /// `(a, b)` or `[a, b]`.
    Items(Vec<Node<'a>>),
    /// `Name` or `Name(..)`: an enum's variant, or a named struct.
    Variant(&'a str, Option<Box<Node<'a>>>),
    /// Numbers, strings, booleans.
    Scalar,
}

/// Reads a whole text into a tree; fails at the first place where it is no RON.
pub fn parse(text: &Text) -> Result<Node<'_>, Diagnostic> {
    parse_slice(text, without_last_comment(&text.text).unwrap_or(&text.text))
}

/// A text without a comment that ends it, which `ron` takes for one only where a line break follows.
fn without_last_comment(text: &str) -> Option<&str> {
    let last_line = text.rfind('\n').map_or(0, |at| at + 1);
    let starts = text[last_line..].match_indices("//").map(|(at, _)| &text[..last_line + at]);
    starts.into_iter().find(|before| ron::from_str::<&RawValue>(before).is_ok())
}

/// Reads a slice of a text into a tree.
pub fn parse_slice<'a>(text: &'a Text, slice: &'a str) -> Result<Node<'a>, Diagnostic> {
    let raw: &RawValue = ron::from_str(slice).map_err(|error| syntax(text, slice, &error))?;
    build(text, raw, 0)
}

/// The error of the `ron` crate at its place within the text.
fn syntax(text: &Text, slice: &str, error: &ron::error::SpannedError) -> Diagnostic {
    let at = error.span.end;
    let start = text.text.len() - text.text[text.text.len().min(offset_in(text, slice))..].len();
    let before = &text.text[..start];
    let line = before.matches('\n').count() + at.line;
    let shift = if at.line == 1 { before.chars().rev().take_while(|c| *c != '\n').count() } else { 0 };
    text.error_at(line, at.col + shift, sentence(&error.code.to_string()))
}

/// Where a slice of a text begins.
fn offset_in(text: &Text, slice: &str) -> usize {
    (slice.as_ptr() as usize).saturating_sub(text.text.as_ptr() as usize)
}

/// The message in the style of ours: a small letter first.
fn sentence(message: &str) -> String {
    let mut characters = message.chars();
    characters.next().map_or_else(String::new, |first| first.to_lowercase().chain(characters).collect())
}

/// The tree of one raw value, which `ron` has found to be well-formed.
fn build<'a>(text: &'a Text, raw: &'a RawValue, depth: usize) -> Result<Node<'a>, Diagnostic> {
    let source = raw.trim().get_ron();
    if depth > MAX_DEPTH {
        return Err(text.error(source, format!("nested more than {MAX_DEPTH} levels deep")));
    }
    let word = source.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(source.len());
    let (name, rest) = source.split_at(word);
    let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_') && !rest.starts_with(['"', '\'', '#']);
    let kind = if is_name {
        variant(text, name, rest, depth)?
    } else if source.starts_with(['(', '[', '{']) {
        level(text, source, depth)?
    } else {
        Kind::Scalar
    };
    Ok(Node { text, source, kind })
}

/// A word, with what follows it in parentheses.
fn variant<'a>(text: &'a Text, name: &'a str, rest: &'a str, depth: usize) -> Result<Kind<'a>, Diagnostic> {
    if matches!(name, "true" | "false" | "inf" | "NaN" | "inff32" | "inff64" | "NaNf32" | "NaNf64") {
        return Ok(Kind::Scalar);
    }
    if rest.is_empty() {
        return Ok(Kind::Variant(name, None));
    }
    let raw: &RawValue = ron::from_str(rest).map_err(|error| syntax(text, rest, &error))?;
    Ok(Kind::Variant(name, Some(Box::new(build(text, raw, depth + 1)?))))
}

/// One level of fields or items.
fn level<'a>(text: &'a Text, source: &'a str, depth: usize) -> Result<Kind<'a>, Diagnostic> {
    let level: Level<'a> = ron::from_str(source).map_err(|error| syntax(text, source, &error))?;
    match level {
        Level::Fields(fields) => {
            let mut list: Vec<(String, &'a str, Node<'a>)> = Vec::with_capacity(fields.len());
            for (key, raw) in fields {
                let node = build(text, raw, depth + 1)?;
                let place = match key {
                    Cow::Borrowed(key) => key,
                    Cow::Owned(_) => number_before(source, raw).unwrap_or(node.source),
                };
                list.push((key.into_owned(), place, node));
            }
            refuse_repeated(text, &list)?;
            Ok(Kind::Fields(list))
        }
        Level::Items(items) => {
            items.into_iter().map(|raw| build(text, raw, depth + 1)).collect::<Result<_, _>>().map(Kind::Items)
        }
    }
}

/// The number that is the key of a value of `source`; none where its key is no number.
fn number_before<'a>(source: &'a str, value: &'a RawValue) -> Option<&'a str> {
    let offset = (value.get_ron().as_ptr() as usize).checked_sub(source.as_ptr() as usize)?;
    let before = source.get(..offset)?.trim_end().strip_suffix(':')?.trim_end();
    let start = before.rfind(|c: char| !(c.is_alphanumeric() || "+-._".contains(c)))? + 1;
    Some(&before[start..]).filter(|number| number.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)))
}

/// A field given twice is an error at its second place.
fn refuse_repeated(text: &Text, fields: &[(String, &str, Node)]) -> Result<(), Diagnostic> {
    let mut seen = std::collections::BTreeSet::new();
    match fields.iter().find(|(name, ..)| !seen.insert(name)) {
        Some((name, place, _)) => Err(text.error(place, format!("`{name}` is given twice")).help("remove one of them")),
        None => Ok(()),
    }
}

/// The direct children of a value, unread.
enum Level<'a> {
    Fields(Vec<(Cow<'a, str>, &'a RawValue)>),
    Items(Vec<&'a RawValue>),
}

impl<'de> Deserialize<'de> for Level<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LevelVisitor)
    }
}

struct LevelVisitor;

impl<'de> Visitor<'de> for LevelVisitor {
    type Value = Level<'de>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("fields or items")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Self::Value, E> {
        Ok(Level::Items(Vec::new()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut fields = Vec::new();
        while let Some(Key(key)) = map.next_key()? {
            fields.push((key, map.next_value()?));
        }
        Ok(Level::Fields(fields))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        while seq.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Level::Items(items))
    }
}

/// A field's name: an identifier, or a string or a number in a map. Borrowed where the text holds it without escapes.
struct Key<'a>(Cow<'a, str>);

impl<'de> Deserialize<'de> for Key<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(KeyVisitor).map(Key)
    }
}

struct KeyVisitor;

impl<'de> Visitor<'de> for KeyVisitor {
    type Value = Cow<'de, str>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_u64<E: de::Error>(self, key: u64) -> Result<Self::Value, E> {
        Ok(Cow::Owned(key.to_string()))
    }

    fn visit_i64<E: de::Error>(self, key: i64) -> Result<Self::Value, E> {
        Ok(Cow::Owned(key.to_string()))
    }

    fn visit_f64<E: de::Error>(self, key: f64) -> Result<Self::Value, E> {
        Ok(Cow::Owned(key.to_string()))
    }

    fn visit_borrowed_str<E: de::Error>(self, key: &'de str) -> Result<Self::Value, E> {
        Ok(Cow::Borrowed(key))
    }

    fn visit_str<E: de::Error>(self, key: &str) -> Result<Self::Value, E> {
        Ok(Cow::Owned(key.to_owned()))
    }
}
