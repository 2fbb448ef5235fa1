//! Light from beyond the scene.

use bevy_ecs::prelude::*;
use glam::Vec3;

/// Light that arrives where no surface is hit.
#[derive(Component, Clone, Debug, PartialEq)]
pub enum Environment {
    /// The same radiance from everywhere, linear Rec.709, each channel at least 0.
    Constant(Vec3),
}
