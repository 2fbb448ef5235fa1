//! Twins of `bounds` and `morton`: the same bits as on the GPU.

use glam::{UVec3, Vec3};

use super::bounds::Bounds;
use crate::layout::tree::{
    BOUNDS_WORDS, CENTROID_HIGH, CENTROID_LOW, CORE_CELLS, MORTON_BITS, OCTAVE_SHIFT, SCENE_HIGH, SCENE_LOW, Triangle,
    core_radius,
};

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

/// What [`core_radius`] says of triangles.
pub fn core_of(triangles: &[Triangle]) -> f32 {
    core_radius(triangles.len() as u32, |i| Bounds::of(&triangles[i as usize]).centre())
}

/// The 63-bit code of each triangle: bit 3i + 2 of it is bit i of the cell along x, then y, then z.
pub fn codes(triangles: &[Triangle], centroids: Bounds, core: f32) -> Vec<u64> {
    let scale = cells_per_metre((centroids.high - centroids.low).max_element());
    let last_cell = Vec3::splat(((1u32 << MORTON_BITS) - 1) as f32);
    let far = centroids.high.max(-centroids.low).max_element() > core;
    let cell = |centre: Vec3| match far {
        true => UVec3::from_array(centre.to_array().map(|x| cell_around_core(x, core))),
        false => ((centre - centroids.low) * scale).clamp(Vec3::ZERO, last_cell).as_uvec3(),
    };
    triangles.iter().map(|triangle| code(cell(Bounds::of(triangle).centre()))).collect()
}

/// The cell along one axis where the scene reaches beyond its core.
fn cell_around_core(x: f32, core: f32) -> u32 {
    let distance = x.abs();
    let number = match distance > core {
        true => CORE_CELLS + ((distance.to_bits() - core.to_bits()) >> OCTAVE_SHIFT),
        false => (distance * (CORE_CELLS as f32 / core)) as u32,
    };
    let middle = 1 << (MORTON_BITS - 1);
    if x < 0.0 { middle - 1 - number } else { middle + number }
}

fn code(cell: UVec3) -> u64 {
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
