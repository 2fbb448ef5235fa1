//! Cameras: pinholes, and thin lenses.

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};

/// A camera. Right-handed world space; `position` and `look_at` differ, `up` is not along the view.
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
    pub lens: Lens,
}

/// What a camera sees through.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lens {
    /// Radius of the lens, scene units; 0 is a pinhole.
    pub aperture: f64,
    /// What is sharp. Nothing to a pinhole.
    pub focus: Focus,
    /// How far the lens is moved against the film, to the right and up, in heights of the film: the picture is of what lies so far
    /// from the viewing axis, and is not turned.
    pub shift: DVec2,
}

/// The plane that a lens shows sharp, across the viewing axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Focus {
    /// Through the point that is looked at.
    #[default]
    LookAt,
    /// So far from the camera along the viewing axis, scene units, above 0.
    Distance(f64),
    /// Through a point of world space.
    At(DVec3),
}

impl Lens {
    /// The greatest radius, scene units.
    pub const MOST_APERTURE: f64 = 1e6;
    /// The greatest shift either way, heights of the film.
    pub const MOST_SHIFT: f64 = 10.0;
    /// Distances that it can be focused to, scene units.
    pub const FOCUS_RANGE: [f64; 2] = [1e-9, 1e12];
}

impl Default for Camera {
    /// A pinhole that looks from (0, 0, 1) to the origin.
    fn default() -> Self {
        Self { position: DVec3::Z, look_at: DVec3::ZERO, up: DVec3::Y, fov_y: 45.0, lens: Lens::default() }
    }
}

impl Camera {
    /// Distance of the sharp plane along the viewing axis, scene units. A point that the camera has passed, or stands beside, is no focus: it
    /// stands for the point that is looked at.
    pub fn focus_distance(&self) -> f64 {
        let view = self.look_at - self.position;
        let looked_at = view.length();
        match self.lens.focus {
            Focus::LookAt => looked_at,
            Focus::Distance(distance) => distance,
            Focus::At(point) => {
                let along = (point - self.position).dot(view.normalize_or(DVec3::NEG_Z));
                if along > 0.0 { along } else { looked_at }
            }
        }
    }
}

/// Marks the one camera that is rendered.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Active;
