//! Light from beyond the scene.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DMat3, UVec2, Vec3};

/// Light that arrives where no surface is hit.
#[derive(Component, Clone, Debug)]
pub enum Environment {
    /// The same radiance from everywhere, linear Rec.709, each channel at least 0.
    Constant(Vec3),
    /// Radiance by direction.
    Map {
        image: Arc<EnvironmentMap>,
        /// What the image's radiance is multiplied by, at least 0.
        strength: f32,
        /// Linear Rec.709 that it is multiplied by too, each channel at least 0.
        tint: Vec3,
        /// A rotation: from directions of the image to those of the scene.
        turn: DMat3,
    },
    /// The sky of a clear day, with its sun.
    Daylight(Daylight),
}

impl PartialEq for Environment {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => a == b,
            (
                Self::Map { image, strength, tint, turn },
                Self::Map { image: other, strength: other_strength, tint: other_tint, turn: other_turn },
            ) => {
                let settings = (strength, tint, turn) == (other_strength, other_tint, other_turn);
                // Pictures are large: the same one is not compared by its pixels.
                settings && (Arc::ptr_eq(image, other) || image == other)
            }
            (Self::Daylight(a), Self::Daylight(b)) => a == b,
            _ => false,
        }
    }
}

/// A clear day by its sun, its haze and its ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Of the sun above the horizon, degrees, 0 to 90.
    pub elevation: f64,
    /// Of the sun from -z towards +x, degrees.
    pub azimuth: f64,
    /// Haze: 1 (none at all) to 10; a clear day has 3.
    pub turbidity: f32,
    /// Reflectance of the ground, linear Rec.709, each channel 0 to 1. It is what is seen below the horizon.
    pub ground: Vec3,
    /// What all radiance is multiplied by, at least 0.
    pub strength: f32,
    /// Angle across the sun's disk, degrees, above 0. What the sun sends does not depend on it.
    pub sun_size: f64,
}

impl Daylight {
    /// Angle across the sun as it is seen from the earth, degrees.
    pub const SUN_SIZE: f64 = 0.533;
}

/// A picture of the whole sphere of directions, by longitude and latitude: constant over each pixel.
///
/// The middle of the picture is towards -z, its right half towards +x, its top row towards +y. So a direction d is in
/// column width * (0.5 + atan2(d.x, -d.z) / (2 pi)), row height * acos(d.y) / pi.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    /// Pixels, each side at least 1.
    pub size: UVec2,
    /// Row by row from the top; linear Rec.709, finite, each channel at least 0.
    pub pixels: Vec<Vec3>,
}
