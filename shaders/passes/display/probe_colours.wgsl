// The numbers of view "probe" as colours, from the least to the greatest: dark violet by blue and green to yellow. Grey: no number was shown;
// red: it is none, or infinite.

import package::gen::{ProbeColours};
import package::lib::ordered::{from_ordered_bits};
import package::lib::probe_number::{is_number, probe_number};

@group(0) @binding(0) var<storage, read> params: ProbeColours;
@group(0) @binding(1) var<storage, read> probe_values: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> probe_range: array<u32>;
@group(0) @binding(3) var<storage, read_write> picture: array<u32>;

const NOTHING: vec3<f32> = vec3<f32>(70.0);
const NO_NUMBER: vec3<f32> = vec3<f32>(230.0, 30.0, 30.0);

// The ends of what is shown.
fn shown_range() -> vec2<f32> {
    if (params.bounded != 0u) {
        return vec2<f32>(params.low, params.high);
    }
    let least = select(probe_range[0], probe_range[2], params.logarithmic != 0u);
    if (least == 0u) {
        return vec2<f32>(0.0);
    }
    return vec2<f32>(from_ordered_bits(~least), from_ordered_bits(probe_range[1]));
}

// Where a number lies between two ends, from 0 to 1; where they are one, in the middle.
fn place(x: f32, ends: vec2<f32>) -> f32 {
    if (ends.x >= ends.y) {
        return select(select(1.0, 0.5, x == ends.x), 0.0, x < ends.x);
    }
    if (params.logarithmic == 0u) {
        // Halved, for their difference may be more than there are numbers.
        return clamp((0.5 * x - 0.5 * ends.x) / (0.5 * ends.y - 0.5 * ends.x), 0.0, 1.0);
    }
    let low = log2(max(ends.x, 0x1p-126));
    return clamp((log2(max(x, 0x1p-126)) - low) / (log2(max(ends.y, 0x1p-126)) - low), 0.0, 1.0);
}

// Colours that grow brighter evenly, and that those who see no red or green tell apart: five of viridis (Smith and van der Walt 2015), and lines
// between them.
fn ramp(t: f32) -> vec3<f32> {
    let at = 4.0 * t;
    var colour = mix(vec3<f32>(68.0, 1.0, 84.0), vec3<f32>(59.0, 82.0, 139.0), min(at, 1.0));
    colour = mix(colour, vec3<f32>(33.0, 145.0, 140.0), clamp(at - 1.0, 0.0, 1.0));
    colour = mix(colour, vec3<f32>(94.0, 201.0, 98.0), clamp(at - 2.0, 0.0, 1.0));
    return mix(colour, vec3<f32>(253.0, 231.0, 37.0), clamp(at - 3.0, 0.0, 1.0));
}

@compute @workgroup_size(256)
fn probe_colours(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = (group.x + group.y * groups.x) * 256u + local;
    if (index >= params.pixels) {
        return;
    }
    let value = probe_values[index];
    var colour = NOTHING;
    if (value.w > 0.0) {
        let number = probe_number(value, params.part);
        colour = NO_NUMBER;
        if (is_number(number)) {
            colour = ramp(place(number, shown_range()));
        }
    }
    let bytes = vec3<u32>(colour + 0.5);
    picture[index] = bytes.x | bytes.y << 8u | bytes.z << 16u | 0xff000000u;
}
