//! The path kernel run over a scene that is loaded, without the engine around it.

use crate::gpu::{GpuError, Runtime};
use crate::layout::trace::TraceParams;
use crate::passes::{Recording, trace};

/// Traces a batch, and leaves it in `radiance`.
pub fn trace_batch(rig: &mut Runtime, params: &TraceParams) -> Result<(), GpuError> {
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    for (name, bytes) in trace::buffers(pixels, params.layers) {
        rig.reserve(name, bytes)?;
    }
    let mut recording = Recording::default();
    trace::record(&mut recording, params);
    rig.play(&recording)
}

/// The same where paths are reused; `params` are of whole blocks. `textured`: materials differ from point to point.
pub fn trace_reused_batch(rig: &mut Runtime, params: &TraceParams, textured: bool) -> Result<(), GpuError> {
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    for (name, bytes) in trace::buffers(pixels, params.layers) {
        rig.reserve(name, bytes)?;
    }
    // All but one at once, so that there are two rounds.
    let at_once = params.layers.max(2) - 1;
    for (name, bytes) in trace::reuse_buffers(pixels, at_once, textured) {
        rig.reserve(name, bytes)?;
    }
    let mut recording = Recording::default();
    trace::record_reused(&mut recording, params, at_once, textured);
    rig.play(&recording)
}
