//! Values to be written into a scene file: as text, and as changes of what is written.

use std::ops::Range;

use glam::{DVec3, Vec3};

use super::number::{double, single};
use super::trivia::comments_within;
use crate::scene::ron::{Kind, Node};

/// A value of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    Single(f32),
    /// `true`, `Path`, `None`, and whole numbers.
    Word(String),
    /// In double quotes.
    Text(String),
    /// One number where all channels are equal, unless three are written.
    Colour(Vec3),
    /// `(a, b)`
    Tuple(Vec<Value>),
    /// `(name: value, ..)`
    Struct(Vec<(String, Value)>),
    /// `{ "name": value, .. }`
    Map(Vec<(String, Value)>),
    /// `Name(..)`
    Variant(String, Box<Value>),
}

impl Value {
    pub fn word(word: impl ToString) -> Self {
        Self::Word(word.to_string())
    }

    pub fn vector(vector: DVec3) -> Self {
        Self::Tuple(vector.to_array().map(Self::Number).to_vec())
    }

    pub fn variant(name: &str, content: Value) -> Self {
        Self::Variant(name.to_owned(), Box::new(content))
    }

    /// In one line.
    pub fn text(&self) -> String {
        match self {
            Self::Number(value) => double(*value),
            Self::Single(value) => single(*value),
            Self::Word(word) => word.clone(),
            Self::Text(text) => format!("{text:?}"),
            Self::Colour(colour) if *colour == Vec3::splat(colour.x) => single(colour.x),
            Self::Colour(colour) => format!("({})", colour.to_array().map(single).join(", ")),
            Self::Tuple(values) => {
                let values: Vec<String> = values.iter().map(Self::text).collect();
                format!("({})", values.join(", "))
            }
            Self::Struct(fields) => format!("({})", listed(fields, str::to_owned)),
            Self::Map(entries) => format!("{{ {} }}", listed(entries, |name| format!("{name:?}"))),
            Self::Variant(name, content) if matches!(**content, Self::Struct(_)) => format!("{name}{}", content.text()),
            Self::Variant(name, content) => format!("{name}({})", content.text()),
        }
    }

    /// Adds to `changes` what is to be exchanged in the text of `node`, so that it is this value: as little as can be.
    pub fn compare(&self, node: &Node, changes: &mut Vec<(Range<usize>, String)>) {
        match (self, &node.kind) {
            (Self::Number(value), Kind::Scalar) if number(node) == Some(*value) => {}
            (Self::Single(value), Kind::Scalar) if number(node).is_some_and(|read| read as f32 == *value) => {}
            (Self::Word(word), _) if node.source == word => {}
            (Self::Text(text), _) if node.string().is_ok_and(|read| read == *text) => {}
            (Self::Colour(colour), Kind::Scalar)
                if number(node).is_some_and(|read| Vec3::splat(read as f32) == *colour) => {}
            (Self::Colour(colour), Kind::Items(items)) if items.len() == 3 => {
                let channels = colour.to_array().map(Self::Single);
                channels.iter().zip(items).for_each(|(channel, item)| channel.compare(item, changes));
            }
            (Self::Tuple(values), Kind::Items(items)) if items.len() == values.len() => {
                values.iter().zip(items).for_each(|(value, item)| value.compare(item, changes));
            }
            (Self::Struct(fields), Kind::Fields(written))
                if has_names(fields, written.iter().map(|(name, ..)| name)) =>
            {
                for (name, _, node) in written {
                    let value = fields.iter().find(|(field, _)| field == name);
                    value.iter().for_each(|(_, value)| value.compare(node, changes));
                }
            }
            (Self::Variant(name, value), Kind::Variant(written, Some(content))) if name == written => {
                value.compare(if is_list(value) { content } else { content.inner() }, changes);
            }
            _ => changes.push((span(node), self.text() + &comments_within(node.source))),
        }
    }

    /// Whether a node is this value already.
    pub fn is(&self, node: &Node) -> bool {
        let mut changes = Vec::new();
        self.compare(node, &mut changes);
        changes.into_iter().all(|(range, text)| node.text.text[range] == text)
    }
}

/// Whether what stands in a variant's brackets are its fields.
fn is_list(value: &Value) -> bool {
    matches!(value, Value::Struct(_))
}

/// Whether fields have these names, and no other.
fn has_names<'n>(fields: &[(String, Value)], names: impl ExactSizeIterator<Item = &'n String>) -> bool {
    fields.len() == names.len() && names.into_iter().all(|name| fields.iter().any(|(field, _)| field == name))
}

fn listed(entries: &[(String, Value)], key: impl Fn(&str) -> String) -> String {
    let entries: Vec<String> = entries.iter().map(|(name, value)| format!("{}: {}", key(name), value.text())).collect();
    entries.join(", ")
}

fn number(node: &Node) -> Option<f64> {
    node.number(f64::MIN, f64::MAX).ok()
}

/// Where a node is in its text, in bytes.
pub fn span(node: &Node) -> Range<usize> {
    let start = offset(node, node.source);
    start..start + node.source.len()
}

/// Where a slice of a node's text begins.
pub fn offset(node: &Node, slice: &str) -> usize {
    (slice.as_ptr() as usize).saturating_sub(node.text.text.as_ptr() as usize)
}
