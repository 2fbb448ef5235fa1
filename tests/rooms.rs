//! Small scenes for the tests of light transport.

use lucerna::gpu::Runtime;
use lucerna::layout::trace::TraceParams;
pub use lucerna::stress::scenes::room::{Room, matte, shiny};
use lucerna::stress::tools::batch;

/// Traces a batch, and leaves it in `radiance`.
pub fn trace_batch(rig: &mut Runtime, params: &TraceParams) {
    batch::trace_batch(rig, params).unwrap();
}

/// The same where paths are reused; `params` are of whole blocks. `textured`: materials differ from point to point.
pub fn trace_reused_batch(rig: &mut Runtime, params: &TraceParams, textured: bool) {
    batch::trace_reused_batch(rig, params, textured).unwrap();
}
