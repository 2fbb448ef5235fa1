//! What half of a tile tells of its variance. The twin of `passes/film/tally`.

use glam::{UVec2, Vec3, Vec4};

use crate::layout::adaptive::{
    MOST_OF_TILE, MOST_TALLIED, PixelMark, TALLY_DARK, TILE_LANES, TallyParams, TallyRun, TileTally, unpack_tile,
};
use crate::layout::film::{FilmHalf, FilmPixel};
use crate::layout::trace::TILE_BLOCK;
use crate::stats::metrics::DARK;

const _: () = assert!(TALLY_DARK == DARK as f32, "what is told is relative as the film's error is");

/// Tallies halves of tiles, and notes the means of their pixels.
pub fn tally(film: &[FilmPixel], marks: &mut [PixelMark], runs: &[TallyRun], params: &TallyParams) -> Vec<TileTally> {
    runs.iter().map(|run| tally_tile(film, marks, run, params)).collect()
}

fn tally_tile(film: &[FilmPixel], marks: &mut [PixelMark], run: &TallyRun, params: &TallyParams) -> TileTally {
    let lanes = TILE_LANES as usize;
    let (mut means, mut offs, mut rays) = (vec![Vec4::ZERO; lanes], vec![Vec3::ZERO; lanes], vec![Vec4::ZERO; lanes]);
    for lane in 0..TILE_LANES {
        let at = TILE_BLOCK * unpack_tile(run.tile) + UVec2::new(lane % TILE_BLOCK, lane / TILE_BLOCK);
        let place = at.wrapping_sub(UVec2::new(params.window_x, params.window_y));
        if place.cmpge(UVec2::new(params.window_width, params.window_height)).any() {
            continue;
        }
        let pixel = (place.y * params.window_width + place.x) as usize;
        let mark = &mut marks[pixel].halves[run.half as usize];
        let mean = mean_of(&film[pixel].halves[run.half as usize], params.scale);
        means[lane as usize] = mean.extend(1.0);
        offs[lane as usize] = mean - mark.mean;
        rays[lane as usize].x = mark.rays as f32;
        mark.mean = mean;
    }
    let means = summed(means);
    let pixels = means.w.max(1.0);
    let radiance = means.truncate() / pixels;
    let weight = 1.0 / (radiance * radiance + TALLY_DARK);
    let errors: Vec<Vec4> = offs.into_iter().map(|off| Vec4::splat((off * off).dot(weight))).collect();
    let most = MOST_OF_TILE * summed(errors.clone()).x / pixels;
    let error = summed(errors.into_iter().map(|error| error.min(Vec4::splat(most))).collect()).x;
    TileTally { mean: means.truncate(), pixels: means.w, error, rays: summed(rays).x, pad0: 0, pad1: 0 }
}

fn mean_of(half: &FilmHalf, scale: f32) -> Vec3 {
    let sum = half.sum.map(|sum| sum.y as f32 * 2f32.powi(32) + sum.x as f32);
    (Vec3::from(sum) * (scale / half.count.max(1) as f32)).min(Vec3::splat(MOST_TALLIED))
}

/// In the order of the pass.
fn summed(mut terms: Vec<Vec4>) -> Vec4 {
    while terms.len() > 1 {
        let upper = terms.split_off(terms.len() / 2);
        terms.iter_mut().zip(upper).for_each(|(term, other)| *term += other);
    }
    terms[0]
}
