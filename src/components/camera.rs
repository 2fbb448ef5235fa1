//! Pinhole cameras.

use bevy_ecs::prelude::*;
use glam::DVec3;

/// A pinhole camera. Right-handed world space; `position` and `look_at` differ, `up` is not along the view.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World space, scene units.
    pub position: DVec3,
    /// World space, scene units.
    pub look_at: DVec3,
    /// World space, any length above 0.
    pub up: DVec3,
    /// Vertical field of view, degrees, above 0 and below 180.
    pub fov_y: f64,
}

/// Marks the one camera that is rendered.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Active;
