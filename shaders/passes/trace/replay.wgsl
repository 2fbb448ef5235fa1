// One sample of one pixel, traced as for the film, with all that happens on its way. It makes nothing of the film.

import package::gen::{Replayed};
import package::passes::trace::path::{params, prepare_workgroup, trace_path};
import package::passes::trace::record::{keep_probed, probed_all, probed_kept, turn_count};

@group(0) @binding(23) var<storage, read_write> replayed: Replayed;

// One invocation of the workgroup traces; the others help to prepare it.
@compute @workgroup_size(8, 8)
fn replay(@builtin(local_invocation_index) lane: u32) {
    prepare_workgroup(lane, 64u);
    if (lane != 0u) {
        return;
    }
    // What the path lends is read by nobody here.
    let sample = trace_path(vec2<u32>(params.window_x, params.window_y), params.first_sample, @if(reuse) 0u);
    // What was shown at the path's end, behind its last ray.
    keep_probed();
    replayed = Replayed(sample.rgb, sample.info, turn_count, probed_all, probed_kept, 0u);
}
