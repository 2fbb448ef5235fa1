//! Emitting triangles, behind an alias table over their power.

use glam::Vec3;

use super::alias::alias_table;
use super::trace::{MATERIAL_ONE_SIDED, MaterialRecord, luminance};
use super::tree::Triangle;

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

impl LightTable {
    /// From triangles in scene order; those that emit nothing, or have no area, are left out. Empty if all of them together are
    /// so dim that the density is beyond f32: they are left to be hit.
    pub fn new(triangles: impl Iterator<Item = Triangle>, records: &[MaterialRecord]) -> Self {
        let (mut lights, mut powers) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let Some(record) = records.get(triangle.material as usize) else { continue };
            let sides = if record.flags & MATERIAL_ONE_SIDED != 0 { 1 } else { 2 };
            let power = area(&triangle) * brightness(record.emission) * f64::from(sides);
            if power > 0.0 && power.is_finite() {
                let Triangle { a, b, c, index, .. } = triangle;
                let emission = record.emission;
                let shrink = shrink_of(&triangle).copysign(if sides == 1 { -1.0 } else { 1.0 });
                lights.push(LightRecord { a, b, c, triangle: index, emission, shrink, ..LightRecord::default() });
                powers.push(power);
            }
        }
        for (light, column) in lights.iter_mut().zip(alias_table(&powers)) {
            (light.threshold, light.other) = (column.threshold, column.other);
        }
        let density = (1.0 / powers.iter().sum::<f64>()) as f32;
        match lights.is_empty() || !density.is_finite() {
            true => Self::default(),
            false => Self { lights, density },
        }
    }
}

impl LightRecord {
    /// Sides that emit: 1 the front alone, or 2.
    pub fn sides(&self) -> u32 {
        if self.shrink < 0.0 { 1 } else { 2 }
    }
}

/// How far, by the distance, a ray may pass from the point that it is aimed at: 2^-20 is more than the roundings of its direction and of
/// a triangle's test come to.
const MISSED: f32 = 1.0 / 1_048_576.0;

/// [`MISSED`] by the radius of the inscribed circle; finite and above 0.
fn shrink_of(triangle: &Triangle) -> f32 {
    let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(Vec3::as_dvec3);
    let around = a.distance(b) + b.distance(c) + c.distance(a);
    (MISSED * (around / (2.0 * area(triangle))) as f32).clamp(f32::MIN_POSITIVE, f32::MAX)
}

/// Scene units squared.
fn area(triangle: &Triangle) -> f64 {
    let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(Vec3::as_dvec3);
    0.5 * (b - a).cross(c - a).length()
}

/// Rec.709 luminance as the kernel has it, so that both agree on a light's share.
fn brightness(emission: Vec3) -> f64 {
    f64::from(luminance(emission))
}
