//! Emitting triangles and point lights to the table that lights are drawn from, by their power.

use glam::Vec3;

use super::cdf::cdf_table;
use crate::layout::light::{LightRecord, LightTable, PointLightRecord};
use crate::layout::trace::{MATERIAL_ONE_SIDED, MaterialRecord, luminance};
use crate::layout::tree::Triangle;

impl LightTable {
    /// From triangles in scene order, what each emits on average, and points; lights that emit nothing, or have no area, are left out. Empty if
    /// all of them together are so dim that the density is beyond f32: triangles are left to be hit, and points say nothing.
    pub fn of(
        triangles: impl Iterator<Item = (Triangle, Vec3)>,
        records: &[MaterialRecord],
        points: &[PointLightRecord],
    ) -> Self {
        let (mut lights, mut powers) = (Vec::new(), Vec::new());
        for (triangle, emission) in triangles {
            let Some(record) = records.get(triangle.material as usize) else { continue };
            let sides = if record.flags & MATERIAL_ONE_SIDED != 0 { 1 } else { 2 };
            let power = area(&triangle) * brightness(emission) * f64::from(sides);
            if power > 0.0 && power.is_finite() {
                let Triangle { a, b, c, index, .. } = triangle;
                let shrink = shrink_of(&triangle).copysign(if sides == 1 { -1.0 } else { 1.0 });
                lights.push(LightRecord { a, b, c, triangle: index, emission, shrink, ..LightRecord::default() });
                powers.push(power);
            }
        }
        for point in points.iter().filter(|point| point.power > 0.0 && point.power.is_finite()) {
            lights.push(LightRecord::from(*point));
            powers.push(f64::from(point.power));
        }
        for (light, entry) in lights.iter_mut().zip(cdf_table(&powers)) {
            (light.end, light.first) = (entry.end, entry.first);
        }
        let density = (1.0 / powers.iter().sum::<f64>()) as f32;
        match lights.is_empty() || !density.is_finite() {
            true => Self::default(),
            false => Self { lights, density },
        }
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
