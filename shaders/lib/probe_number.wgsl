// The one number that stands for what code shows of itself.

import package::gen::{PROBE_LENGTH, PROBE_VEC2};

// Of a vector, a channel or its length; anything else is a number already. `value` has 1 + the type behind it.
fn probe_number(value: vec4<f32>, part: u32) -> f32 {
    if (value.w < f32(PROBE_VEC2 + 1u)) {
        return value.x;
    }
    if (part >= PROBE_LENGTH) {
        return length(value.xyz);
    }
    return value[part];
}

// Whether it is neither NaN nor infinite, by its bits: WGSL may assume that neither exists.
fn is_number(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}
