//! A value of a scene file, as its numbers and the text around them.

use crate::scene::ron::{Kind, Node};

/// Any finite number is one: what a path takes, its reader says.
const FARTHEST: f64 = f64::MAX;

/// A value whose numbers can be others.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// One more than numbers: before the first, between each two, and behind the last.
    texts: Vec<String>,
    pub numbers: Vec<f64>,
}

impl Value {
    /// A value by its numbers.
    pub fn of(node: &Node) -> Self {
        let mut value = Self { texts: vec![String::new()], numbers: Vec::new() };
        value.add(node);
        value
    }

    /// Whether all but the numbers is the same.
    pub fn is_like(&self, other: &Self) -> bool {
        self.texts == other.texts
    }

    /// As it would be written, with as many other numbers.
    pub fn with(&self, numbers: impl Iterator<Item = f64>) -> String {
        let mut texts = self.texts.iter();
        let first = texts.next().cloned().unwrap_or_default();
        texts.zip(numbers).fold(first, |written, (text, number)| written + &number.to_string() + text)
    }

    fn add(&mut self, node: &Node) {
        match &node.kind {
            Kind::Scalar => match node.number(-FARTHEST, FARTHEST) {
                Ok(number) => {
                    self.numbers.push(number);
                    self.texts.push(String::new());
                }
                Err(_) => self.write(node.source),
            },
            Kind::Variant(name, content) => {
                self.write(name);
                content.iter().for_each(|content| self.add(content));
            }
            Kind::Items(items) => {
                let ends = if node.source.starts_with('[') { ["[", "]"] } else { ["(", ")"] };
                self.list(ends, items.iter().map(|item| (String::new(), item)));
            }
            Kind::Fields(fields) if node.source.starts_with('{') => {
                self.list(["{", "}"], fields.iter().map(|(name, _, node)| (format!("{name:?}: "), node)));
            }
            Kind::Fields(fields) => {
                self.list(["(", ")"], fields.iter().map(|(name, _, node)| (format!("{name}: "), node)));
            }
        }
    }

    fn list<'n, 'a: 'n>(&mut self, [open, close]: [&str; 2], parts: impl Iterator<Item = (String, &'n Node<'a>)>) {
        self.write(open);
        for (place, (name, node)) in parts.enumerate() {
            self.write(if place == 0 { "" } else { ", " });
            self.write(&name);
            self.add(node);
        }
        self.write(close);
    }

    fn write(&mut self, text: &str) {
        if let Some(last) = self.texts.last_mut() {
            last.push_str(text);
        }
    }
}
