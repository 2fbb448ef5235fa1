// View "debug": the first sample of every pixel, traced as for the film; its picture is what the code on its way shows of itself.

import package::lib::colour::{srgb8};
import package::lib::debug::{debug_colour};
import package::passes::trace::path::{params, prepare_workgroup, trace_path};

@group(0) @binding(17) var<storage, read_write> debug_colours: array<vec4<f32>>;
@group(0) @binding(18) var<storage, read_write> picture: array<u32>;

@compute @workgroup_size(8, 8)
fn debug_view(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    prepare_workgroup(lane, 64u);
    if (id.x >= params.window_width || id.y >= params.window_height) {
        return;
    }
    let pixel = id.y * params.window_width + id.x;
    // What a path lends is read by nobody here: all leave it in one place.
    _ = trace_path(id.xy + vec2<u32>(params.window_x, params.window_y), 0u, @if(reuse) 0u);
    debug_colours[pixel] = debug_colour;
    picture[pixel] = srgb8(debug_colour.xyz);
}
