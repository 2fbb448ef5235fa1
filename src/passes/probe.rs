//! A number that shaders show of themselves (`probe("name", value)`, `lib/probe.wgsl`) of every pixel, and its picture in place of the film's.

use super::trace::{TRACED, reuse_buffers};
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size, Twin};
use crate::layout::probe::{PROBE_FIRST, PROBE_LENGTH, ProbeChoice, ProbeColours};
use crate::layout::trace::TraceParams;

/// Of the first sample of each pixel the first number that `probe_asked` asks for, with 1 + its type behind it, in `probe_values`; and the range of
/// all of them in `probe_range`, which is zero before. Which name and bounce that is, is data: another compiles nothing.
pub static PROBE: Pass = Pass {
    name: "probe",
    module: "passes/trace/probe",
    entry: "probe_view",
    features: &["probe_view"],
    bindings: &Binding::list::<24>(&[
        &TRACED,
        &[
            Binding::read("probe_asked", "ProbeChoice"),
            Binding::write("probe_values", "array<vec4<f32>>"),
            Binding::write("probe_range", "array<atomic<u32>>"),
        ],
    ]),
    makes: &[Makes::Picture],
    twin: Twin::None("what is shown is up to whoever edits a shader, and the path beneath has a twin"),
};

/// Those numbers as colours in `picture`.
pub static PROBE_COLOURS: Pass = Pass {
    name: "probe colours",
    module: "passes/display/probe_colours",
    entry: "probe_colours",
    features: &[],
    bindings: &[
        Binding::params("ProbeColours"),
        Binding::read("probe_values", "array<vec4<f32>>"),
        Binding::read("probe_range", "array<u32>"),
        Binding::write("picture", "array<u32>"),
    ],
    makes: &[Makes::Picture],
    twin: twin!(probe::probe_colours),
};

/// How the numbers of a name are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbeLook {
    /// The bounce that they are of; none: each pixel's first, at whatever bounce.
    pub bounce: Option<u32>,
    /// Of vectors, a channel, or `PROBE_LENGTH`.
    pub part: u32,
    /// Colours are even in the logarithm.
    pub logarithmic: bool,
    /// What the first and the last colour stand for; none: the least and the greatest number.
    pub range: Option<[f32; 2]>,
}

impl Default for ProbeLook {
    fn default() -> Self {
        Self { bounce: None, part: PROBE_LENGTH, logarithmic: false, range: None }
    }
}

impl ProbeLook {
    /// What is asked of each pixel, of a name by its number.
    pub fn choice(&self, name: u32) -> ProbeChoice {
        ProbeChoice { name, bounce: self.bounce.unwrap_or(PROBE_FIRST), part: self.part, pad0: 0 }
    }

    /// Parameters of the colours of so many pixels.
    pub fn colours(&self, pixels: u32) -> ProbeColours {
        let [low, high] = self.range.unwrap_or_default();
        let (bounded, logarithmic) = (self.range.is_some().into(), self.logarithmic.into());
        ProbeColours { pixels, part: self.part, logarithmic, bounded, low, high, pad0: 0, pad1: 0 }
    }
}

/// Buffers for so many numbers, beside `picture`; of what paths lend there is one place.
pub fn buffers(pixels: u64) -> Vec<(&'static str, u64)> {
    let mut buffers = reuse_buffers(1, 1, true);
    buffers.extend([("probe_values", pixels.max(1) * 16), ("probe_range", RANGE)]);
    buffers
}

/// The same for one pixel, of so many bounces: beside those of the picture.
pub fn pixel_buffers(bounces: u32) -> Vec<(&'static str, u64)> {
    let mut buffers = reuse_buffers(1, 1, true);
    buffers.extend([("probe_pixel", u64::from(bounces.max(1)) * 16), ("probe_pixel_range", RANGE)]);
    buffers
}

/// Bytes of a range.
const RANGE: u64 = 16;

/// Records the numbers of the window of `params`, as `probe_asked` asks for them. Nothing may be recorded before.
pub fn record(recording: &mut Recording, params: &TraceParams) {
    recording.zero("probe_range", RANGE);
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: 1 };
    recording.run(&PROBE, size).params(&TraceParams { first_sample: 0, ..*params });
}

/// Records those of the first pixel of the window of `params` at each of so many bounces, into `probe_pixel`.
pub fn record_pixel(recording: &mut Recording, params: &TraceParams, bounces: u32) {
    let params = TraceParams { window_width: 1, window_height: 1, ..*params };
    let size = Size::Pixels { width: 1, height: 1, layers: bounces };
    let call = recording.run(&PROBE, size).params(&params);
    call.bind("probe_values", "probe_pixel").bind("probe_range", "probe_pixel_range");
}

/// Records the picture of what [`record`] left.
pub fn record_colours(recording: &mut Recording, params: &ProbeColours) {
    recording.run(&PROBE_COLOURS, Size::Items(u64::from(params.pixels))).params(params);
}
