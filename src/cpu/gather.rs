//! What the pixels of a tile gather of what their paths lend, in f64: the twin of `passes/trace/gather`.

use glam::{DVec3, UVec2, UVec4};

use super::bsdf::BsdfValue;
use super::path::{PathScene, Traced, Walked};
use super::pcg4d::pcg4d;
use super::reuse::{GatherPoint, LentPoint};
use crate::layout::texture::NO_CHANCE;
use crate::layout::trace::{LEAST_FACING, TILE_BLOCK, TILE_PIXELS, TraceParams};

/// Sets the hashes that deal quads to tiles off from those of other numbers.
const DEAL_STREAM: u32 = 0x6465_616c;

/// How a pixel sees a point that is lent, if nothing is in between: by area there.
struct Link {
    at: BsdfValue,
    direction: DVec3,
}

impl PathScene<'_> {
    /// A film sample of all pixels of the block whose first pixel this is, tile by tile; none beyond the film's edge.
    pub fn sample_block(&self, params: &TraceParams, first: UVec2, sample: u32) -> Vec<(UVec2, Traced)> {
        let film = UVec2::new(params.film_width, params.film_height);
        let dealt = deal_quads(first / TILE_BLOCK, params.seed);
        let tiles = (0..TILE_BLOCK * TILE_BLOCK / TILE_PIXELS).flat_map(|tile| {
            let pixels = (0..TILE_PIXELS).map(|slot| first + pixel_of(tile, slot, dealt));
            let walked = pixels
                .map(|pixel| pixel.cmplt(film).all().then(|| (pixel, self.walk(params, pixel, sample, true))))
                .collect();
            self.gather(walked)
        });
        tiles.collect()
    }

    /// What the pixels of a tile have, with what they gather of what their paths lend.
    fn gather(&self, walked: Vec<Option<(UVec2, Walked)>>) -> Vec<(UVec2, Traced)> {
        let mut rays = vec![0; walked.len()];
        let gather_points: Vec<_> =
            walked.iter().map(|at| at.as_ref().and_then(|(_, walked)| walked.gather_point)).collect();
        let mut light = vec![DVec3::ZERO; walked.len()];
        for (k, at) in walked.iter().enumerate() {
            let Some(point) = at.as_ref().and_then(|(_, walked)| walked.lent_point) else { continue };
            let linked: Vec<Option<BsdfValue>> = gather_points
                .iter()
                .enumerate()
                .map(|(m, from)| {
                    let link = from.as_ref().and_then(|from| link(from, &point)).filter(|link| link.at.pdf > 0.0)?;
                    rays[m] += 1;
                    let drawn = || pcg4d(UVec4::new(point.chance, m as u32, k as u32, 0)).x | 1;
                    let chance = match point.chance {
                        NO_CHANCE => NO_CHANCE,
                        own if m == k => own,
                        _ => drawn(),
                    };
                    let hit = self.closest_there(from.as_ref()?.position, link.direction, chance)?;
                    (hit.triangle.index == point.triangle).then_some(link.at)
                })
                .collect();
            let total: f64 = linked.iter().flatten().map(|at| at.pdf).sum();
            if linked[k].is_none() {
                light[k] += point.weight * point.radiance;
                continue;
            }
            for (light, at) in light.iter_mut().zip(&linked) {
                *light += at.map_or(DVec3::ZERO, |at| at.value / total * point.radiance);
            }
        }
        let gathered = walked.into_iter().zip(light.into_iter().zip(rays));
        gathered
            .filter_map(|(at, (light, rays))| {
                let (pixel, Walked { traced, .. }) = at?;
                Some((pixel, Traced { radiance: traced.radiance + light, rays: traced.rays + rays }))
            })
            .collect()
    }
}

/// How the quads of a block are dealt to its tiles: two bits of the first and one of the second a quad.
fn deal_quads(block: UVec2, seed: u32) -> [u32; 2] {
    let words = pcg4d(UVec4::new(block.x, block.y, seed, DEAL_STREAM));
    [words.x, words.y]
}

/// Where a pixel of a tile is in its block; `slot` is its quad.
fn pixel_of(tile: u32, slot: u32, [turns, swaps]: [u32; 2]) -> UVec2 {
    let at = tile ^ (turns >> (2 * slot) & 3);
    let [x, y] = if swaps >> slot & 1 == 0 { [at & 1, at >> 1] } else { [at >> 1, at & 1] };
    let side = TILE_BLOCK / 2;
    2 * UVec2::new(slot % side, slot / side) + UVec2::new(x, y)
}

/// None where the point does not look from there as it does to its own path.
fn link(from: &GatherPoint, point: &LentPoint) -> Option<Link> {
    let offset = point.position - from.position;
    let direction = offset.normalize();
    let cos_lent = -point.geometric.dot(direction);
    let is_bent = -point.normal.dot(direction) < f64::from(LEAST_FACING).min(cos_lent);
    if cos_lent <= 0.0 || is_bent {
        return None;
    }
    let BsdfValue { value, pdf } = from.surface.evaluate(&from.frame, direction);
    let above = direction.dot(from.frame.shading) > 0.0 && direction.dot(from.frame.geometric) > 0.0;
    // Where nothing is carried a path ends, and so never comes to draw the point.
    let by_area = if above && value.max_element() > 0.0 { cos_lent / offset.length_squared() } else { 0.0 };
    Some(Link { at: BsdfValue { value: value * by_area, pdf: pdf * by_area }, direction })
}
