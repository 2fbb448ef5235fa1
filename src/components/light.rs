//! Lights without extent: points, and points that shine into a cone.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};

/// A point that sends out light. It has no surface: nothing hits it, and it is seen by what it lights alone.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// World space, scene units.
    pub position: DVec3,
    /// Radiant intensity, W/sr where radiance is W/(m^2 sr); along the axis, of a spot. Linear Rec.709, finite, each channel at least 0.
    pub intensity: Vec3,
    /// Into which it shines; none shines everywhere.
    pub cone: Option<SpotCone>,
}

/// The cone of a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotCone {
    /// A point of its axis, world space, scene units; not the light's position.
    pub look_at: DVec3,
    /// Across the whole cone, degrees, of [`SpotCone::ANGLES`].
    pub angle: f64,
    /// The part of the way from the cone's edge to its axis, by angle, on which the light grows to its whole intensity: 0 (a sharp edge)
    /// to 1 (grows up to the axis).
    pub blend: f64,
}

impl PointLight {
    /// The greatest intensity of a channel.
    pub const MOST_INTENSITY: f64 = 1e12;
}

impl SpotCone {
    /// Angles across that it may have, degrees.
    pub const ANGLES: [f64; 2] = [0.01, 180.0];
    /// Angle across, degrees, where none is given.
    pub const ANGLE: f64 = 45.0;
    /// Blend where none is given.
    pub const BLEND: f64 = 0.15;
}
