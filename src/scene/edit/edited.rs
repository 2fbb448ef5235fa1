//! What became of a scene file's text.

use std::collections::BTreeSet;

use crate::scene::diagnostic::{Diagnostic, Severity};

/// Names that a summary lists.
const LISTED: usize = 3;

/// A scene file's text after edits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edited {
    pub text: String,
    /// Values that were written, and are others now.
    pub changed: usize,
    /// Values, or whole entries, that were not written.
    pub added: usize,
    /// The paths of all of them, in parts.
    pub paths: Vec<Vec<String>>,
    /// What could not be written: warnings, each with what to do.
    pub left_out: Vec<Diagnostic>,
    /// What was written and is not seen everywhere: warnings.
    pub notes: Vec<Diagnostic>,
}

impl Edited {
    /// A text as it is.
    pub fn of(text: String) -> Self {
        Self { text, ..Self::default() }
    }

    /// Whether the text is as it was.
    pub fn is_unchanged(&self) -> bool {
        self.changed + self.added == 0
    }

    /// `3 values changed, 1 added (cameras.front, materials.ball)`
    pub fn summary(&self) -> String {
        let values = |count: usize| if count == 1 { "1 value".to_owned() } else { format!("{count} values") };
        let counts = match (self.changed, self.added) {
            (0, 0) => return "nothing to save".to_owned(),
            (changed, 0) => format!("{} changed", values(changed)),
            (0, added) => format!("{} added", values(added)),
            (changed, added) => format!("{} changed, {added} added", values(changed)),
        };
        let entries: BTreeSet<String> = self.paths.iter().map(|path| path[..path.len().min(2)].join(".")).collect();
        let listed: Vec<&str> = entries.iter().take(LISTED).map(String::as_str).collect();
        let more = if entries.len() > LISTED { ", .." } else { "" };
        format!("{counts} ({}{more})", listed.join(", "))
    }

    /// Notes those of the paths that change with time, or have a part that does. `tracks` are paths with keys, and where they stand.
    pub fn tell_animated<'t>(&mut self, tracks: impl Iterator<Item = (&'t str, &'t Diagnostic)>) {
        for (track, place) in tracks {
            let plain = |c: &char| !['"', ']'].contains(c);
            let keyed: String = track.chars().filter(plain).map(|c| if c == '[' { '.' } else { c }).collect();
            let is_part = |whole: &str, part: &str| {
                part.strip_prefix(whole).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            };
            let meets = |path: &Vec<String>| is_part(&path.join("."), &keyed) || is_part(&keyed, &path.join("."));
            if self.paths.iter().any(meets) {
                let message = format!("`{track}` has keys, which count in an animation: they are as they were");
                let note = Diagnostic { severity: Severity::Warning, message, ..place.clone() };
                self.notes.push(note.help("edit the keys by hand: `animate` of the scene file"));
            }
        }
    }
}
