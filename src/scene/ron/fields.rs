//! Typed reading of a tree: each wrong value is reported where it stands, and reading goes on.

use std::cell::{Cell, RefCell};

use super::tree::{Kind, Node};
use crate::scene::diagnostic::{Diagnostic, Diagnostics};
use crate::scene::suggest::did_you_mean;

/// Where the readers of one tree put what they find wrong.
#[derive(Debug, Default)]
pub struct Reader {
    diagnostics: RefCell<Diagnostics>,
}

impl Reader {
    /// Reports an error about a node.
    pub fn error(&self, node: &Node, path: &str, message: impl std::fmt::Display) {
        self.push(node.text.error(node.source, format!("{path}: {message}")));
    }

    /// Reports anything.
    pub fn push(&self, diagnostic: Diagnostic) {
        self.diagnostics.borrow_mut().push(diagnostic);
    }

    /// Whether an error was reported.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.borrow().has_errors()
    }

    /// Everything that was reported, in the order of the text.
    pub fn into_diagnostics(self) -> Diagnostics {
        let mut diagnostics = self.diagnostics.into_inner();
        diagnostics.list.sort_by(|a, b| (&a.file, a.line, a.column).cmp(&(&b.file, b.line, b.column)));
        diagnostics
    }
}

/// The named fields of one value, taken one by one; those never asked for are reported as unknown.
pub struct Fields<'r, 'a> {
    reader: &'r Reader,
    node: &'r Node<'a>,
    /// The field path of the value itself, empty at the root.
    path: String,
    fields: &'r [(String, &'a str, Node<'a>)],
    asked: RefCell<Vec<&'static str>>,
    sound: Cell<bool>,
}

impl<'r, 'a> Fields<'r, 'a> {
    /// Opens a value written `(name: value, ..)`; reports anything else.
    pub fn open(reader: &'r Reader, node: &'r Node<'a>, path: &str) -> Option<Self> {
        let fields = match &node.kind {
            Kind::Fields(fields) => fields.as_slice(),
            Kind::Items(items) if items.is_empty() => &[],
            _ => {
                let place = if path.is_empty() { "the file" } else { path };
                reader.error(node, place, format!("expected fields, as in (name: value), found {}", node.describe()));
                return None;
            }
        };
        Some(Self { reader, node, path: path.to_owned(), fields, asked: RefCell::default(), sound: Cell::new(true) })
    }

    /// Reads the field `name` by `read`, which gets its node and field path; `None` where it is absent or wrong.
    pub fn read<T>(&self, name: &'static str, read: impl FnOnce(&Node<'a>) -> Result<T, String>) -> Option<T> {
        let node = self.get(name)?;
        match read(node) {
            Ok(value) => Some(value),
            Err(message) => {
                self.reader.error(node, &self.path_of(name), message);
                self.sound.set(false);
                None
            }
        }
    }

    /// Like [`Fields::read`], and reports an absent field.
    pub fn require<T>(&self, name: &'static str, read: impl FnOnce(&Node<'a>) -> Result<T, String>) -> Option<T> {
        if self.get(name).is_none() {
            self.fail(format!("the field `{name}` is missing"));
        }
        self.read(name, read)
    }

    /// The node of a field, which counts as known from here on. `None` (RON's) is absent.
    pub fn get(&self, name: &'static str) -> Option<&'r Node<'a>> {
        self.written(name).filter(|node| !node.is_none())
    }

    /// The same, of a field that may be `None`.
    fn written(&self, name: &'static str) -> Option<&'r Node<'a>> {
        self.asked.borrow_mut().push(name);
        self.fields.iter().find(|(field, ..)| field == name).map(|(.., node)| node)
    }

    /// Reads a field that has parts, and may be `None`, by what reports by itself. `None` where it is absent or wrong.
    pub fn part<T>(&self, name: &'static str, read: impl FnOnce(&Reader, &Node<'a>, &str) -> Option<T>) -> Option<T> {
        let part = read(self.reader, self.written(name)?, &self.path_of(name));
        self.sound.set(self.sound.get() && part.is_some());
        part
    }

    /// Reports an error about the whole value.
    pub fn fail(&self, message: impl std::fmt::Display) {
        let path = if self.path.is_empty() { "the file" } else { &self.path };
        self.reader.error(self.node, path, message);
        self.sound.set(false);
    }

    /// The field path of a field.
    pub fn path_of(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    /// Reports the fields nobody asked for. Whether every field was right.
    pub fn finish(self) -> bool {
        let asked = self.asked.borrow();
        for (name, place, node) in self.fields {
            if !asked.contains(&name.as_str()) {
                let mut known: Vec<&str> = Vec::new();
                for name in asked.iter() {
                    if !known.contains(name) {
                        known.push(name);
                    }
                }
                let help = did_you_mean(name, known.iter().copied())
                    .unwrap_or_else(|| format!("known fields: {}", known.join(", ")));
                let message = format!("unknown field `{}`", self.path_of(name));
                self.reader.push(node.text.error(place, message).help(help));
                self.sound.set(false);
            }
        }
        self.sound.get()
    }
}
