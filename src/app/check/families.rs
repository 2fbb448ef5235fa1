//! What `lucerna check` asks of the members of a family beside their scenes: whether their shaders have the values that are set.

use std::path::Path;

use crate::app::variants::code::Codes;
use crate::scene::variants::{is_family, plan};
use crate::scene::{Assets, Diagnostic, Severity};

/// What is wrong with the shaders of members; nothing where a file is no family, or is wrong itself.
pub fn wrong_code(file: &Path) -> Vec<Diagnostic> {
    let assets = Assets::new();
    let family = is_family(file, &assets).then(|| plan(file, &[], &assets));
    let Some(Ok(family)) = family else { return Vec::new() };
    let mut codes = Codes::new(None);
    let mut found: Vec<Diagnostic> = Vec::new();
    for member in &family.members {
        if let Err(message) = codes.number(member) {
            let error = Diagnostic { severity: Severity::Error, message, ..member.place.clone() };
            if !found.contains(&error) {
                found.push(error);
            }
        }
    }
    found
}
