//! The environment's pixels, and the tables by which a direction is drawn: a row of the picture, then a pixel of the row. And the
//! sun, which is no pixel.

use std::f64::consts::PI;

use glam::{UVec2, Vec3, Vec4};

use super::cdf::CdfEntry;

/// An environment as the kernel reads it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkyTable {
    /// Columns and rows.
    pub size: UVec2,
    /// Row by row from the top: radiance, linear Rec.709; w is 0.
    pub cells: Vec<Vec4>,
    /// An entry a row of the picture, then an entry a pixel, of each row by itself.
    pub cdf: Vec<CdfEntry>,
    /// Integral of the luminance over the sphere, by solid angle; 0 where it is so little that 1 / power is beyond f32, so that no
    /// direction can be drawn.
    pub power: f64,
    /// The largest channel of any pixel.
    pub brightest: f32,
}

/// The disk of the sun: the same radiance from everywhere in a cone of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Its middle, unit length.
    pub direction: Vec3,
    /// Beside that of the sky; linear Rec.709.
    pub radiance: Vec3,
    /// Of a unit vector at the disk's edge from its middle: the distance squared, above 0.
    pub chord_squared: f32,
}

impl Sun {
    /// Of all directions in it.
    pub fn solid_angle(&self) -> f64 {
        PI * f64::from(self.chord_squared)
    }
}
