//! Twins of `bounds` and `morton`: the same bits as on the GPU.

use glam::Vec3;

use crate::layout::tree::{BOUNDS_WORDS, CENTROID_HIGH, CENTROID_LOW, MORTON_BITS, SCENE_HIGH, SCENE_LOW, Triangle};

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

/// What the bounds pass finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneBounds {
    /// The box of the centres of the triangles' boxes.
    pub centroids: Bounds,
    /// The box of all triangles.
    pub scene: Bounds,
}

impl SceneBounds {
    /// The contents of `centroid_bounds`.
    pub fn words(&self) -> [u32; BOUNDS_WORDS as usize] {
        let mut words = [0; BOUNDS_WORDS as usize];
        let corners = [
            (CENTROID_LOW, self.centroids.low, true),
            (CENTROID_HIGH, self.centroids.high, false),
            (SCENE_LOW, self.scene.low, true),
            (SCENE_HIGH, self.scene.high, false),
        ];
        for (first, corner, least) in corners {
            for axis in 0..3 {
                let key = ordered_bits(corner[axis]);
                words[first as usize + axis] = if least { !key } else { key };
            }
        }
        words
    }

    /// What the contents of `centroid_bounds` say. Over no triangles at all they say nothing.
    pub fn from_words(words: &[u32; BOUNDS_WORDS as usize]) -> Self {
        let corner = |first: u32, flip: u32| {
            Vec3::from_array([0, 1, 2].map(|axis| from_ordered_bits(words[first as usize + axis] ^ flip)))
        };
        Self {
            centroids: Bounds { low: corner(CENTROID_LOW, u32::MAX), high: corner(CENTROID_HIGH, 0) },
            scene: Bounds { low: corner(SCENE_LOW, u32::MAX), high: corner(SCENE_HIGH, 0) },
        }
    }
}

/// A float as an unsigned integer of the same order.
pub fn ordered_bits(x: f32) -> u32 {
    let bits = x.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 0x8000_0000 }
}

/// The inverse of [`ordered_bits`].
pub fn from_ordered_bits(key: u32) -> f32 {
    f32::from_bits(if key >> 31 == 1 { key & 0x7fff_ffff } else { !key })
}

/// The bounds of a scene.
pub fn bounds(triangles: &[Triangle]) -> SceneBounds {
    let nothing = SceneBounds { centroids: Bounds::EMPTY, scene: Bounds::EMPTY };
    triangles.iter().map(Bounds::of).fold(nothing, |all, one| {
        let centre = one.centre();
        SceneBounds {
            centroids: all.centroids.joined(Bounds { low: centre, high: centre }),
            scene: all.scene.joined(one),
        }
    })
}

/// The 63-bit code of each triangle: bit 3i + 2 of it is bit i of the cell along x, then y, then z.
pub fn codes(triangles: &[Triangle], centroids: Bounds) -> Vec<u64> {
    let extents = centroids.high - centroids.low;
    let scale = cells_per_metre(extents.max_element());
    triangles.iter().map(|triangle| code(Bounds::of(triangle).centre() - centroids.low, scale)).collect()
}

fn code(offset: Vec3, scale: f32) -> u64 {
    let last_cell = ((1u32 << MORTON_BITS) - 1) as f32;
    let cell = (offset * scale).clamp(Vec3::ZERO, Vec3::splat(last_cell)).as_uvec3();
    (0..MORTON_BITS).fold(0, |code, bit| {
        let triple = (cell.x >> bit & 1) << 2 | (cell.y >> bit & 1) << 1 | (cell.z >> bit & 1);
        code | u64::from(triple) << (3 * bit)
    })
}

/// Cells per metre, as the shader takes it: 2^21 / extent, rounded down by at most 2^-14 of itself; 0 for an extent that
/// is below 2^-103 or not finite.
pub fn cells_per_metre(extent: f32) -> f32 {
    let bits = extent.to_bits();
    let exponent = bits >> 23;
    if !(24..=254).contains(&exponent) {
        return 0.0;
    }
    let significand = 0x8000 + ((bits & 0x7f_ffff) >> 8) + 1;
    let quotient = u32::MAX / significand;
    quotient as f32 * f32::from_bits((MORTON_BITS + 237 - exponent) << 23)
}
