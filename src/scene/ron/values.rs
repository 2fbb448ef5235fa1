//! Readers of single values. Each says what it expected and what it found.

use glam::{DVec3, Vec3};

use super::tree::{Kind, Node};

impl<'a> Node<'a> {
    /// The value in words, for messages.
    pub fn describe(&self) -> String {
        let short: String = self.source.chars().take(40).collect();
        let dots = if short.len() < self.source.len() { ".." } else { "" };
        match &self.kind {
            Kind::Fields(_) => "fields".into(),
            Kind::Items(items) => format!("{} values", items.len()),
            _ => format!("`{short}{dots}`"),
        }
    }

    /// The named children, of fields or a map.
    pub fn fields(&self) -> Result<&[(String, &'a str, Node<'a>)], String> {
        match &self.kind {
            Kind::Fields(fields) => Ok(fields),
            Kind::Items(items) if items.is_empty() => Ok(&[]),
            _ => Err(format!("expected named entries, as in {{ \"name\": (..) }}, found {}", self.describe())),
        }
    }

    /// The children of a list or tuple.
    pub fn items(&self) -> Result<&[Node<'a>], String> {
        match &self.kind {
            Kind::Items(items) => Ok(items),
            _ => Err(format!("expected a list, found {}", self.describe())),
        }
    }

    /// A string, or a bare word.
    pub fn string(&self) -> Result<String, String> {
        match &self.kind {
            Kind::Variant(name, None) => Ok((*name).to_owned()),
            Kind::Scalar => ron::from_str(self.source).map_err(|_| self.expected("a string in double quotes")),
            _ => Err(self.expected("a string in double quotes")),
        }
    }

    /// A finite number within a range.
    pub fn number(&self, min: f64, max: f64) -> Result<f64, String> {
        let value: f64 = match &self.kind {
            Kind::Scalar => ron::from_str(self.source).map_err(|_| self.expected("a number"))?,
            _ => return Err(self.expected("a number")),
        };
        if value >= min && value <= max && value.is_finite() {
            return Ok(value);
        }
        Err(format!("expected a number from {min} to {max}, found `{}`", self.source))
    }

    /// A whole number within a range.
    pub fn integer(&self, min: u32, max: u32) -> Result<u32, String> {
        let value: Option<u32> = matches!(self.kind, Kind::Scalar).then(|| ron::from_str(self.source).ok()).flatten();
        value
            .filter(|value| (min..=max).contains(value))
            .ok_or_else(|| self.expected(&format!("a whole number from {min} to {max}")))
    }

    /// `true` or `false`.
    pub fn boolean(&self) -> Result<bool, String> {
        match self.source {
            "true" => Ok(true),
            "false" => Ok(false),
            _ => Err(self.expected("true or false")),
        }
    }

    /// A fixed count of numbers within a range.
    pub fn numbers<const N: usize>(&self, min: f64, max: f64) -> Result<[f64; N], String> {
        let items = self.items().ok().filter(|items| items.len() == N);
        let items = items.ok_or_else(|| self.expected(&format!("{N} numbers in parentheses")))?;
        let mut values = [0.0; N];
        for (value, item) in values.iter_mut().zip(items) {
            *value = item.number(min, max)?;
        }
        Ok(values)
    }

    /// A fixed count of whole numbers within a range.
    pub fn integers<const N: usize>(&self, min: u32, max: u32) -> Result<[u32; N], String> {
        let items = self.items().ok().filter(|items| items.len() == N);
        let items = items.ok_or_else(|| self.expected(&format!("{N} whole numbers in parentheses")))?;
        let mut values = [0; N];
        for (value, item) in values.iter_mut().zip(items) {
            *value = item.integer(min, max)?;
        }
        Ok(values)
    }

    /// Three numbers, any finite.
    pub fn vector(&self) -> Result<DVec3, String> {
        self.numbers(-1e12, 1e12).map(DVec3::from_array)
    }

    /// Three numbers, or one for all three channels.
    pub fn colour(&self, max: f64) -> Result<Vec3, String> {
        match &self.kind {
            Kind::Items(_) => self.numbers(0.0, max).map(DVec3::from_array),
            _ => self.number(0.0, max).map(DVec3::splat),
        }
        .map(|colour| colour.as_vec3())
    }

    /// What stands in the parentheses of `name(..)`, where that is one value.
    pub fn inner(&self) -> &Self {
        match &self.kind {
            Kind::Items(items) if items.len() == 1 => &items[0],
            _ => self,
        }
    }

    /// Whether it is `None`, which in maps takes away what the file that is extended has.
    pub fn is_none(&self) -> bool {
        matches!(self.kind, Kind::Variant("None", None))
    }

    /// One of some words.
    pub fn one_of<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, String> {
        let Kind::Variant(name, None) = &self.kind else { return Err(self.expected_word(words)) };
        words.iter().find(|(word, _)| word == name).map(|(_, value)| *value).ok_or_else(|| self.expected_word(words))
    }

    fn expected_word<T>(&self, words: &[(&str, T)]) -> String {
        let all: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        self.expected(&all.join(" or "))
    }

    fn expected(&self, what: &str) -> String {
        format!("expected {what}, found {}", self.describe())
    }
}
