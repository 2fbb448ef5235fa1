//! Emitting triangles, behind an alias table over their power.

use glam::Vec3;

gpu_struct! {
    /// An emitting triangle, and the column of the alias table at its index.
    pub struct LightRecord {
        /// First corner, world space relative to the scene's origin.
        pub a: Vec3,
        /// Where the column stands for this very light: below this remainder, 0 to 1.
        pub threshold: f32,
        /// Second corner.
        pub b: Vec3,
        /// The light it stands for otherwise.
        pub other: u32,
        /// Third corner.
        pub c: Vec3,
        /// Index of the triangle in scene order.
        pub triangle: u32,
        /// Emitted radiance, linear Rec.709.
        pub emission: Vec3,
        /// By which part of the way to the light's middle a drawn point is moved there, for a unit of distance from the viewer, so that
        /// rounding can't make a ray miss the light. Below 0 where the front alone emits.
        pub shrink: f32,
    }
}

/// All emitting triangles, ready to be drawn by their power.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightTable {
    /// In scene order.
    pub lights: Vec<LightRecord>,
    /// 1 / the sum of all powers: a point of a light is drawn with the density `luminance * sides * density` by area. 0 without
    /// lights.
    pub density: f32,
}

impl LightRecord {
    /// Sides that emit: 1 the front alone, or 2.
    pub fn sides(&self) -> u32 {
        if self.shrink < 0.0 { 1 } else { 2 }
    }
}
