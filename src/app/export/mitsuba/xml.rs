//! Elements of Mitsuba's scene files, and their text.

use std::fmt::Write;

use glam::{DMat4, DVec3, Vec3};

/// An element with its attributes and what is in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    tag: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub fn new(tag: &'static str) -> Self {
        Self { tag, attributes: Vec::new(), children: Vec::new() }
    }

    /// An object of some kind (`bsdf`, `shape`, `emitter`, ..), made by a plugin.
    pub fn plugin(kind: &'static str, plugin: &str) -> Self {
        Self::new(kind).attribute("type", plugin)
    }

    pub fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// The parameter of its parent that it is.
    pub fn named(self, name: &str) -> Self {
        self.attribute("name", name)
    }

    pub fn with(mut self, child: Self) -> Self {
        self.children.push(child);
        self
    }

    fn value(self, tag: &'static str, name: &str, value: String) -> Self {
        self.with(Self::new(tag).named(name).attribute("value", value))
    }

    pub fn float(self, name: &str, value: f64) -> Self {
        self.value("float", name, value.to_string())
    }

    pub fn integer(self, name: &str, value: u64) -> Self {
        self.value("integer", name, value.to_string())
    }

    pub fn boolean(self, name: &str, value: bool) -> Self {
        self.value("boolean", name, value.to_string())
    }

    pub fn string(self, name: &str, value: &str) -> Self {
        self.value("string", name, value.to_owned())
    }

    /// Linear Rec.709.
    pub fn rgb(self, name: &str, colour: Vec3) -> Self {
        self.value("rgb", name, format!("{}, {}, {}", colour.x, colour.y, colour.z))
    }

    pub fn point(self, name: &str, at: DVec3) -> Self {
        let [x, y, z] = at.to_array().map(|value| value.to_string());
        self.with(Self::new("point").named(name).attribute("x", x).attribute("y", y).attribute("z", z))
    }

    /// A transform by its matrix.
    pub fn matrix(self, name: &str, matrix: DMat4) -> Self {
        let rows = matrix.transpose().to_cols_array().map(|value| value.to_string()).join(" ");
        self.with(Self::new("transform").named(name).with(Self::new("matrix").attribute("value", rows)))
    }

    /// A camera's place.
    pub fn look_at(self, name: &str, [origin, target, up]: [DVec3; 3]) -> Self {
        let text = |v: DVec3| format!("{}, {}, {}", v.x, v.y, v.z);
        let look = Self::new("lookat").attribute("origin", text(origin)).attribute("target", text(target));
        self.with(Self::new("transform").named(name).with(look.attribute("up", text(up))))
    }

    /// The whole file.
    pub fn document(&self) -> String {
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
        self.write(&mut text, 0);
        text
    }

    fn write(&self, text: &mut String, depth: usize) {
        let indent = "    ".repeat(depth);
        let _ = write!(text, "{indent}<{}", self.tag);
        for (name, value) in &self.attributes {
            let _ = write!(text, " {name}=\"{}\"", escaped(value));
        }
        if self.children.is_empty() {
            *text += "/>\n";
            return;
        }
        *text += ">\n";
        self.children.iter().for_each(|child| child.write(text, depth + 1));
        let _ = writeln!(text, "{indent}</{}>", self.tag);
    }
}

/// As the value of an attribute. A `$` begins a parameter of Mitsuba's, and characters of control may not be there at all.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '$' => out.push('_'),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
