//! Axis-parallel boxes.

use glam::Vec3;

use crate::layout::ray::SLAB_GROWTH;
use crate::layout::tree::Triangle;

/// Least and greatest corner of an axis-parallel box, in the unit of what it encloses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub low: Vec3,
    pub high: Vec3,
}

impl Bounds {
    /// What encloses nothing: joined with any box, it gives that box.
    pub const EMPTY: Self = Self { low: Vec3::MAX, high: Vec3::MIN };

    /// The box of one triangle, exact.
    pub fn of(triangle: &Triangle) -> Self {
        let low = triangle.a.min(triangle.b).min(triangle.c);
        let high = triangle.a.max(triangle.b).max(triangle.c);
        Self { low, high }
    }

    /// The box of one triangle, grown by what slabs need (`padded_box` in `lib/intersect`).
    pub fn padded(triangle: &Triangle) -> Self {
        padded_box(triangle.a, triangle.b, triangle.c)
    }

    /// The least box that encloses both.
    pub fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Its centre, rounded.
    pub fn centre(self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// Half of its surface, in f64; 0 for a box that encloses nothing.
    pub fn half_area(self) -> f64 {
        let size = (self.high.as_dvec3() - self.low.as_dvec3()).max(glam::DVec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

/// A triangle's box, grown by what its own coordinates need.
pub fn padded_box(a: Vec3, b: Vec3, c: Vec3) -> Bounds {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let growth = SLAB_GROWTH * high.max(-low).max_element();
    Bounds { low: low - growth, high: high + growth }
}
