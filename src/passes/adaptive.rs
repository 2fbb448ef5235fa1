//! Adaptive films: samples by lists of tiles, and what halves of tiles tell of their variance.

use super::trace::{GATHER, PATH};
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::adaptive::{PixelMark, TallyParams, TallyRun, TileRun, TileSample, TileTally};
use crate::layout::film::AccumulateParams;
use crate::layout::trace::TraceParams;
use crate::passes::film::ACCUMULATE;

/// Compares each pixel's mean in half of a tile with what it was, and sums up; notes the mean.
pub static TALLY: Pass = Pass {
    name: "tally",
    module: "passes/film/tally",
    entry: "tally",
    features: &[],
    bindings: &[
        Binding::params("TallyParams"),
        Binding::read("tally_runs", "array<TallyRun>"),
        Binding::read("film", "array<FilmPixel>"),
        Binding::write("marks", "array<PixelMark>"),
        Binding::write("tallies", "array<TileTally>"),
    ],
    makes: &[Makes::Film],
    twin: twin!(tally::tally),
};

/// Buffers of an adaptive film for a window of so many pixels, beside those of any film.
pub fn buffers(pixels: u64) -> Vec<(&'static str, u64)> {
    let lists = [("tile_samples", size_of::<TileSample>()), ("tile_runs", size_of::<TileRun>())];
    let marks = ("marks", pixels.max(1) * size_of::<PixelMark>() as u64);
    lists.into_iter().map(|(name, bytes)| (name, bytes as u64)).chain([marks]).collect()
}

/// Buffers of what so many halves of tiles tell.
pub fn tally_buffers(runs: u64) -> Vec<(&'static str, u64)> {
    vec![("tally_runs", runs * size_of::<TallyRun>() as u64), ("tallies", runs * size_of::<TileTally>() as u64)]
}

/// Records that the film of so many pixels starts anew, beside [`film::record_reset`](super::film::record_reset).
pub fn record_reset(recording: &mut Recording, pixels: u32) {
    recording.zero("marks", u64::from(pixels) * size_of::<PixelMark>() as u64);
}

/// Records what `tile_samples` lists into `radiance`: `params.tile_samples` of them, 64 places each. Where paths are reused (`textured`: and
/// materials differ from point to point), with what comes of that.
pub fn record_tiles(recording: &mut Recording, params: &TraceParams, reuses: bool, textured: bool) {
    let size = Size::Groups([params.tile_samples, 1, 1]);
    recording.run(&PATH, size).params(params);
    if reuses {
        let call = recording.run(&GATHER, size).params(params);
        if textured {
            call.bind("materials", "gather_materials");
        }
    }
}

/// Records the adding of those samples to the film: `params.runs` tiles of `tile_runs`.
pub fn record_accumulate(recording: &mut Recording, params: &AccumulateParams) {
    recording.run(&ACCUMULATE, Size::Groups([params.runs, 1, 1])).params(params);
}

/// Records what `params.runs` halves of tiles, as `tally_runs` lists them, leave in `tallies`.
pub fn record_tally(recording: &mut Recording, params: &TallyParams) {
    recording.run(&TALLY, Size::Groups([params.runs, 1, 1])).params(params);
}
