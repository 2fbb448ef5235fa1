//! The film: samples added to 64-bit fixed point, and the film as a picture.

use glam::UVec2;

use super::lattice::Lattice;
use super::recording::CallBuilder;
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::film::{AccumulateParams, DisplayParams, FilmCounters, FilmPixel};
use crate::layout::trace::TraceParams;

/// Adds a batch of radiance samples to the film, and counts its rays and bad samples.
pub static ACCUMULATE: Pass = Pass {
    name: "accumulate",
    module: "passes/film/accumulate",
    entry: "accumulate",
    features: &[],
    bindings: &[
        Binding::params("AccumulateParams"),
        Binding::read("radiance", "array<RadianceSample>"),
        Binding::write("film", "array<FilmPixel>"),
        Binding::write("counters", "FilmCounters"),
        Binding::read("tile_samples", "array<TileSample>").when(&["adaptive"]),
        Binding::read("tile_runs", "array<TileRun>").when(&["adaptive"]),
        Binding::write("marks", "array<PixelMark>").when(&["adaptive"]),
    ],
    makes: &[Makes::Film],
    twin: twin!(film::accumulate),
};

/// The mean of both halves, exposed, by a tone curve, as sRGB in `picture`: r in the lowest byte, a = 255 in the highest.
pub static DISPLAY: Pass = Pass {
    name: "display",
    module: "passes/display/display",
    entry: "display",
    features: &[],
    bindings: &[
        Binding::params("DisplayParams"),
        Binding::read("film", "array<FilmPixel>"),
        Binding::write("picture", "array<u32>"),
    ],
    makes: &[Makes::Picture],
    twin: twin!(display::display),
};

/// Buffers of the film for a window of so many pixels.
pub fn buffers(pixels: u64) -> Vec<(&'static str, u64)> {
    let pixels = pixels.max(1);
    vec![
        ("film", pixels * size_of::<FilmPixel>() as u64),
        ("counters", size_of::<FilmCounters>() as u64),
        ("picture", pixels * 4),
    ]
}

/// Records that the film of so many pixels starts anew.
pub fn record_reset(recording: &mut Recording, pixels: u32) {
    recording.zero("film", u64::from(pixels) * size_of::<FilmPixel>() as u64);
    recording.zero("counters", size_of::<FilmCounters>() as u64);
}

/// Records that the film counts rays and bad samples anew, and keeps its pixels.
pub fn record_recount(recording: &mut Recording) {
    recording.zero("counters", size_of::<FilmCounters>() as u64);
}

/// Records the adding of what a trace kernel left in `radiance`.
pub fn record_accumulate(recording: &mut Recording, params: &AccumulateParams) {
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    recording.run(&ACCUMULATE, Size::Items(pixels)).params(params);
}

/// Parameters of the accumulate pass after a trace with `trace`. `window` has the parameters for all of the film's window.
pub fn accumulate_params(trace: &TraceParams, exponent: i32, window: &TraceParams) -> AccumulateParams {
    let (x, y) = (trace.window_x - window.window_x, trace.window_y - window.window_y);
    AccumulateParams {
        film_width: trace.film_width,
        window_x: trace.window_x,
        window_y: trace.window_y,
        window_width: trace.window_width,
        window_height: trace.window_height,
        first_sample: trace.first_sample,
        layers: trace.layers,
        exponent,
        first_pixel: y * window.window_width + x,
        row: window.window_width,
        column_shift: trace.column_shift,
        row_shift: trace.row_shift,
        radiance_first: 0,
        radiance_row: trace.window_width,
        radiance_layer: trace.window_width * trace.window_height,
        replaces: 0,
        runs: 0,
    }
}

/// Has the accumulate pass take its pixels out of more that were traced, with `traced`.
pub fn take_from(params: &mut AccumulateParams, traced: &TraceParams) {
    let (x, y) = (params.window_x - traced.window_x, params.window_y - traced.window_y);
    params.radiance_first = y * traced.window_width + x;
    params.radiance_row = traced.window_width;
    params.radiance_layer = traced.window_width * traced.window_height;
}

/// How a film is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Stops: the picture is multiplied by 2^exposure.
    pub exposure: f32,
    /// A `TONE_` curve of that.
    pub tone: u32,
}

/// Records the picture of a film.
pub fn record_display<'a>(recording: &'a mut Recording, params: &DisplayParams) -> CallBuilder<'a> {
    let size = UVec2::new(params.row, params.pixels / params.row.max(1));
    let blocks = Lattice { first: UVec2::ZERO, shift: UVec2::new(params.column_shift, params.row_shift) };
    recording.run(&DISPLAY, Size::Items(blocks.pixels(size))).params(params)
}

/// Parameters of the display pass for a film of such a size, where each pixel of `shown` stands for its block.
pub fn display_params(size: UVec2, shown: Lattice, exponent: i32, look: Look) -> DisplayParams {
    let scale = 2f64.powf(f64::from(look.exposure) - f64::from(exponent));
    DisplayParams {
        pixels: size.x * size.y,
        row: size.x,
        column_shift: shown.shift.x,
        row_shift: shown.shift.y,
        scale: (scale as f32).clamp(f32::MIN_POSITIVE, f32::MAX),
        tone: look.tone,
        by_halves: 0,
    }
}
