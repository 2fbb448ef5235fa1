//! Which members are to be rendered.

use std::ops::Range;

/// Some members of a family, or all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    All,
    Named(Vec<String>),
    /// By their places in the order of the file.
    Range(Range<usize>),
}

impl Wanted {
    /// Whether the member at a place, by its name, is among them.
    pub fn has(&self, place: usize, name: &str) -> bool {
        match self {
            Self::All => true,
            Self::Named(names) => names.iter().any(|wanted| wanted == name),
            Self::Range(places) => places.contains(&place),
        }
    }
}
