//! Paths of values in a scene file.

/// One step from a value to one within it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Of a block of fields, `(name: ..)`.
    Field(&'static str),
    /// Of a block of named entries, `{ "name": .. }`.
    Key(String),
    /// Into `Name(..)`.
    Variant(&'static str),
    /// Of a list.
    Item(usize),
}

impl Step {
    /// The names of a path, as `-D` has them.
    pub fn names(path: &[Step]) -> Vec<String> {
        let name = |step: &Step| match step {
            Self::Field(name) => Some((*name).to_owned()),
            Self::Key(name) => Some(name.clone()),
            Self::Variant(_) => None,
            Self::Item(at) => Some(at.to_string()),
        };
        path.iter().filter_map(name).collect()
    }

    /// A path as `-D` takes it.
    pub fn shown(path: &[Step]) -> String {
        let quoted = |name: String| if name.contains(['.', '[', '"']) { format!("\"{name}\"") } else { name };
        Self::names(path).into_iter().map(quoted).collect::<Vec<_>>().join(".")
    }
}
