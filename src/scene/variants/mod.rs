//! Families of scenes: a file says what of a scene is exchanged, and each choice is a member.

mod family;
mod file;
mod label;
mod member;
mod sweep;
mod target;
mod values;

use std::path::Path;

use super::assets::Assets;
use super::define::Define;
use super::diagnostic::Diagnostics;

pub use family::{Axis, Chosen, Family, Goal, MOST_MEMBERS, Member};
pub use file::is_family;

/// Reads a variant file into its members. `defines` change what its scene is before members do. No scene is read, and no value but those of
/// the file itself looked at: a path that leads nowhere is told when a member is loaded.
pub fn plan(path: &Path, defines: &[Define], assets: &Assets) -> Result<Family, Diagnostics> {
    let mut files = Vec::new();
    let family = file::read_family(path, assets, &mut files)?;
    member::enumerate(path, family, defines, files)
}
