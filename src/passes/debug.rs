//! What shaders show of themselves (`debug` in `lib/debug.wgsl`), as a picture: in place of the film's.

use super::trace::{TRACED, reuse_buffers};
use super::{Binding, Makes, Pass, Recording, Size, Twin};
use crate::layout::trace::TraceParams;

/// The colour that the first sample of each pixel showed last, linear in `debug_colours` (and 1, or all 0 where it showed none), and as sRGB
/// codes in `picture`.
pub static DEBUG: Pass = Pass {
    name: "debug",
    module: "passes/trace/debug",
    entry: "debug_view",
    features: &["debug_view"],
    bindings: &Binding::list::<23>(&[
        &TRACED,
        &[Binding::write("debug_colours", "array<vec4<f32>>"), Binding::write("picture", "array<u32>")],
    ]),
    makes: &[Makes::Picture],
    twin: Twin::None("what is shown is up to whoever edits a shader, and the path beneath has a twin"),
};

/// Buffers for a window of so many pixels, beside `picture`; of what paths lend there is one place.
pub fn buffers(pixels: u64) -> Vec<(&'static str, u64)> {
    let mut buffers = reuse_buffers(1, 1, true);
    buffers.push(("debug_colours", pixels.max(1) * 16));
    buffers
}

/// Records the picture of the window of `params`.
pub fn record(recording: &mut Recording, params: &TraceParams) {
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: 1 };
    recording.run(&DEBUG, size).params(params);
}
