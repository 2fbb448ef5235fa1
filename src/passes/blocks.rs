//! Sums over blocks of each pixel's samples, beside the film: what a robust mean is made of, where that is wanted.

use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::film::{AccumulateParams, RobustPixel};

/// Adds a batch of radiance samples to the blocks, as [`ACCUMULATE`](super::film::ACCUMULATE) does to the film.
pub static BLOCKS: Pass = Pass {
    name: "blocks",
    module: "passes/film/blocks",
    entry: "add_blocks",
    features: &[],
    bindings: &[
        Binding::params("AccumulateParams"),
        Binding::read("radiance", "array<RadianceSample>"),
        Binding::write("blocks", "array<RobustPixel>"),
    ],
    makes: &[Makes::Film],
    twin: twin!(robust::add_blocks),
};

/// The buffer for a window of so many pixels.
pub fn buffers(pixels: u64) -> Vec<(&'static str, u64)> {
    vec![("blocks", pixels.max(1) * size_of::<RobustPixel>() as u64)]
}

/// Records that the blocks of so many pixels are empty.
pub fn record_reset(recording: &mut Recording, pixels: u32) {
    recording.zero("blocks", u64::from(pixels) * size_of::<RobustPixel>() as u64);
}

/// Records the adding of what a trace kernel left in `radiance`.
pub fn record(recording: &mut Recording, params: &AccumulateParams) {
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    recording.run(&BLOCKS, Size::Items(pixels)).params(params);
}
