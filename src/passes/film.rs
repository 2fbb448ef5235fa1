//! The film: samples added to 64-bit fixed point, and the film as a picture.

use super::recording::CallBuilder;
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size, clear};
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
    ],
    makes: &[Makes::Film],
    twin: twin!(film::accumulate),
};

/// The mean of both halves, exposed, as sRGB in `picture`: r in the lowest byte, a = 255 in the highest.
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
    clear(recording, "film", 0, pixels * (size_of::<FilmPixel>() / 4) as u32);
    clear(recording, "counters", 0, (size_of::<FilmCounters>() / 4) as u32);
}

/// Records the adding of what a trace kernel with `trace` left in `radiance`. The first pixel of its window is number
/// `first_pixel` of the film.
pub fn record_accumulate(recording: &mut Recording, trace: &TraceParams, exponent: i32, first_pixel: u32) {
    let pixels = u64::from(trace.window_width) * u64::from(trace.window_height);
    recording.run(&ACCUMULATE, Size::Items(pixels)).params(&accumulate_params(trace, exponent, first_pixel));
}

/// Parameters of the accumulate pass after a trace with `trace`.
pub fn accumulate_params(trace: &TraceParams, exponent: i32, first_pixel: u32) -> AccumulateParams {
    AccumulateParams {
        film_width: trace.film_width,
        window_x: trace.window_x,
        window_y: trace.window_y,
        window_width: trace.window_width,
        window_height: trace.window_height,
        first_sample: trace.first_sample,
        layers: trace.layers,
        exponent,
        first_pixel,
    }
}

/// Records the picture of a film of so many pixels; `exposure` in stops.
pub fn record_display(recording: &mut Recording, pixels: u32, exponent: i32, exposure: f32) -> CallBuilder<'_> {
    recording.run(&DISPLAY, Size::Items(u64::from(pixels))).params(&display_params(pixels, exponent, exposure))
}

/// Parameters of the display pass.
pub fn display_params(pixels: u32, exponent: i32, exposure: f32) -> DisplayParams {
    let scale = 2f64.powf(f64::from(exposure) - f64::from(exponent));
    DisplayParams { pixels, scale: (scale as f32).clamp(f32::MIN_POSITIVE, f32::MAX) }
}
