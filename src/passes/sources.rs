//! Samples with what each of their rays brings, and by which way: for who wants to know where a film's error comes from.

use super::trace::{TRACED, buffers as samples, record_gather, reuse_buffers};
use super::twin::twin;
use super::{Binding, Pass, Recording, Size};
use crate::layout::sources::Contribution;
use crate::layout::trace::TraceParams;

/// Traces as [`PATH`](super::trace::PATH) does, and leaves what rays bring in `brought`: the first contribution of all paths, then the second of
/// all. How many a path has is in `brought_counts`.
pub static SOURCES: Pass = Pass {
    name: "sources",
    module: "passes/trace/sources",
    entry: "sources",
    features: &["sources"],
    bindings: &Binding::list::<23>(&[
        &TRACED,
        &[Binding::write("radiance", "array<RadianceSample>"), Binding::write("brought_counts", "array<u32>")],
    ]),
    makes: &[],
    twin: twin!(sources::brought),
};

/// Buffers for a batch of `params`, of whose paths so many contributions are kept; `reuse` as it is for
/// [`record`].
pub fn buffers(params: &TraceParams, slots: u32, reuse: Option<bool>) -> Vec<(&'static str, u64)> {
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    let paths = (pixels * u64::from(params.layers)).max(1);
    let mut buffers = samples(pixels, params.layers);
    buffers.push(("brought", paths * u64::from(slots) * size_of::<Contribution>() as u64));
    buffers.push(("brought_counts", paths * 4));
    buffers.extend(reuse.into_iter().flat_map(|textured| reuse_buffers(pixels, params.layers, textured)));
    buffers
}

/// Records a batch. `reuse` where paths are reused: then `params` are of whole blocks, and it says whether materials differ from point to point.
pub fn record(recording: &mut Recording, params: &TraceParams, reuse: Option<bool>) {
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: params.layers };
    recording.run(&SOURCES, size).params(params);
    if let Some(textured) = reuse {
        record_gather(recording, params, textured);
    }
}
