//! Emitting triangles and point lights, drawn by the sums of their powers.

use glam::Vec3;

use super::ray::NO_HIT;

gpu_struct! {
    /// An emitting triangle, and the entry of the table of sums at its index ([`super::cdf::CdfEntry`]).
    pub struct LightRecord {
        /// First corner, world space relative to the scene's origin.
        pub a: Vec3,
        /// Sum of the powers up to this light, of all together.
        pub end: f32,
        /// Second corner.
        pub b: Vec3,
        /// The first light that a number of this bucket may be for.
        pub first: u32,
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

    /// A point light, in the place of a triangle: in the row of a [`LightRecord`] whose triangle is [`NO_HIT`].
    pub struct PointLightRecord {
        /// World space relative to the scene's origin.
        pub position: Vec3,
        /// As in [`LightRecord`].
        pub end: f32,
        /// Where a spot shines, unit length; zero of a light that shines everywhere.
        pub axis: Vec3,
        /// As in [`LightRecord`].
        pub first: u32,
        /// At which 1 - cos of the angle to the axis a spot's light is gone.
        pub fade_end: f32,
        /// By how much the part of it that is there grows for a unit of 1 - cos less, before it is smoothed.
        pub fade_scale: f32,
        /// Luminance of all that it sends out, by pi, as a triangle of area A and luminance L sends A L from a side: by this it is drawn.
        pub power: f32,
        /// [`NO_HIT`].
        pub triangle: u32,
        /// Radiant intensity, along the axis of a spot; linear Rec.709.
        pub intensity: Vec3,
        pub pad: f32,
    }
}

const _: () = {
    use std::mem::offset_of;
    assert!(size_of::<PointLightRecord>() == size_of::<LightRecord>());
    assert!(offset_of!(PointLightRecord, end) == offset_of!(LightRecord, end));
    assert!(offset_of!(PointLightRecord, first) == offset_of!(LightRecord, first));
    assert!(offset_of!(PointLightRecord, triangle) == offset_of!(LightRecord, triangle));
};

/// All lights, ready to be drawn by their power.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightTable {
    /// Triangles in scene order, then point lights in the order of their names.
    pub lights: Vec<LightRecord>,
    /// 1 / the sum of all powers: a point of a triangle is drawn with the density `luminance * sides * density` by area, a point light with
    /// the probability `power * density`. 0 without lights.
    pub density: f32,
}

impl LightRecord {
    /// Sides that emit: 1 the front alone, or 2.
    pub fn sides(&self) -> u32 {
        if self.shrink < 0.0 { 1 } else { 2 }
    }

    /// The point light in this row, if it is one.
    pub fn point(&self) -> Option<PointLightRecord> {
        (self.triangle == NO_HIT).then(|| bytemuck::cast(*self))
    }
}

impl LightTable {
    /// Whether some of its lights are points.
    pub fn has_points(lights: &[LightRecord]) -> bool {
        lights.last().is_some_and(|light| light.point().is_some())
    }
}

impl From<PointLightRecord> for LightRecord {
    fn from(point: PointLightRecord) -> Self {
        bytemuck::cast(PointLightRecord { triangle: NO_HIT, ..point })
    }
}
