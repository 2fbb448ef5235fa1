// A batch of samples, traced as for the film, with what each of their rays brings and how it came. It makes nothing of the film.

import package::passes::trace::brought::{begin_bringing, brought_count};
import package::passes::trace::path::{params, prepare_workgroup, radiance, trace_path};

// How much each path has brought.
@group(0) @binding(30) var<storage, read_write> brought_counts: array<u32>;

@compute @workgroup_size(8, 8)
fn sources(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    prepare_workgroup(lane, 64u);
    if (id.x >= params.window_width || id.y >= params.window_height || id.z >= params.layers) {
        return;
    }
    let place = (id.z * params.window_height + id.y) * params.window_width + id.x;
    begin_bringing(place, params.layers * params.window_height * params.window_width);
    let pixel = id.xy + vec2<u32>(params.window_x, params.window_y);
    radiance[place] = trace_path(pixel, params.first_sample + id.z, @if(reuse) place);
    brought_counts[place] = brought_count;
}
