//! Families of scenes: a file says what of a scene is exchanged, and each choice is a member; as is each frame of an animation.

mod family;
mod file;
mod frames;
mod label;
mod member;
mod sweep;
mod target;
mod values;

use std::path::{Path, PathBuf};

use super::assets::Assets;
use super::define::Define;
use super::diagnostic::Diagnostics;
use super::load::{Loaded, attempt_in};
use super::textures::Loading;

pub use family::{Axis, Chosen, Family, Goal, MOST_MEMBERS, Member};
pub use file::is_family;
pub use frames::frames;

/// Reads a variant file into its members. `defines` change what its scene is before members do. No scene is read, and no value but those of
/// the file itself looked at: a path that leads nowhere is told when a member is loaded.
pub fn plan(path: &Path, defines: &[Define], assets: &Assets) -> Result<Family, Diagnostics> {
    let mut files = Vec::new();
    let family = file::read_family(path, assets, &mut files)?;
    member::enumerate(path, family, defines, files)
}

/// The scene that a member is, and every file that was read or looked for.
pub fn load(
    family: &Family,
    member: &Member,
    loading: &Loading,
    assets: &Assets,
) -> (Result<Loaded, Diagnostics>, Vec<PathBuf>) {
    match &member.wrong {
        Some(wrong) => (Err(wrong.clone().into()), Vec::new()),
        None => attempt_in(family.scene_of(member), &member.defines, false, loading, assets),
    }
}
