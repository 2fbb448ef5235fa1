// What is wrong with a number, from its bits: WGSL may assume that neither NaN nor infinity exists.

import package::gen::{BAD_INFINITE, BAD_NAN, BAD_NEGATIVE};

fn fault_of_channel(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    let magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) {
        return BAD_NAN;
    }
    if (magnitude == 0x7f800000u) {
        return BAD_INFINITE;
    }
    return select(0u, BAD_NEGATIVE, bits > 0x80000000u);
}

// A `BAD_` kind of the first bad channel, or 0.
fn fault_of(v: vec3<f32>) -> u32 {
    if (all(bitcast<vec3<u32>>(v) < vec3<u32>(0x7f800000u))) {
        return 0u;
    }
    let x = fault_of_channel(v.x);
    let y = fault_of_channel(v.y);
    return select(select(fault_of_channel(v.z), y, y != 0u), x, x != 0u);
}
