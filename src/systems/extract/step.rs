//! The order of the extraction.

use bevy_ecs::prelude::*;

/// The order within the phase: each reads what those before it made.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    Settings,
    Textures,
    Materials,
    Meshes,
    Uvs,
    Lights,
    Sky,
    Shot,
    Film,
    Beginning,
}
