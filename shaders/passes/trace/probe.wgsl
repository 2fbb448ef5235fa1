// View "probe": the first sample of every pixel, traced as for the film, for a number that code on its way shows of itself; and the range of all
// these numbers. Of one pixel, each layer asks for the next bounce.

import package::gen::{ProbeChoice};
import package::lib::ordered::{ordered_bits};
import package::lib::probe::{probe_choice, probe_value};
import package::lib::probe_number::{is_number, probe_number};
import package::passes::trace::path::{params, prepare_workgroup, trace_path};

@group(0) @binding(25) var<storage, read> probe_asked: ProbeChoice;
@group(0) @binding(26) var<storage, read_write> probe_values: array<vec4<f32>>;
// The least, the greatest and the least above 0, as bits that are ordered, of which those of the least are complemented; 0 where there is none.
@group(0) @binding(27) var<storage, read_write> probe_range: array<atomic<u32>>;

@compute @workgroup_size(8, 8)
fn probe_view(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    prepare_workgroup(lane, 64u);
    if (id.x >= params.window_width || id.y >= params.window_height) {
        return;
    }
    probe_choice = probe_asked;
    probe_choice.bounce += id.z;
    // What a path lends is read by nobody here: all leave it in one place.
    _ = trace_path(id.xy + vec2<u32>(params.window_x, params.window_y), params.first_sample, @if(reuse) 0u);
    probe_values[(id.z * params.window_height + id.y) * params.window_width + id.x] = probe_value;
    let number = probe_number(probe_value, probe_choice.part);
    if (probe_value.w > 0.0 && is_number(number)) {
        atomicMax(&probe_range[0], ~ordered_bits(number));
        atomicMax(&probe_range[1], ordered_bits(number));
        if (number > 0.0) {
            atomicMax(&probe_range[2], ~ordered_bits(number));
        }
    }
}
