// 64-bit fixed point in two words, low word first.

import package::gen::{SAMPLE_BITS};

struct Fixed {
    words: vec2<u32>,
    // The words are meaningless: the number does not fit.
    too_large: bool,
}

// x * 2^exponent to the nearest whole number, ties up; x finite and at least 0 (or -0). Works on x's bits, so that neither
// rounding modes nor flushed denormals matter. Too large from 2^SAMPLE_BITS on.
fn fixed_point(x: f32, exponent: i32) -> Fixed {
    let bits = bitcast<u32>(x) & 0x7fffffffu;
    let biased = bits >> 23u;
    let mantissa = select((bits & 0x7fffffu) | 0x800000u, bits, biased == 0u);
    // x = mantissa * 2^(max(biased, 1) - 150).
    let shift = i32(max(biased, 1u)) - 150 + exponent;
    if (mantissa == 0u || shift < -24) {
        return Fixed(vec2<u32>(0u), false);
    }
    if (shift < 0) {
        let down = u32(-shift);
        return Fixed(vec2<u32>((mantissa + (1u << (down - 1u))) >> down, 0u), false);
    }
    if (shift + 24 > i32(SAMPLE_BITS)) {
        return Fixed(vec2<u32>(0u), true);
    }
    let up = u32(shift);
    if (up >= 32u) {
        return Fixed(vec2<u32>(0u, mantissa << (up - 32u)), false);
    }
    // Two shifts, since one by 32 is none.
    return Fixed(vec2<u32>(mantissa << up, (mantissa >> 1u) >> (31u - up)), false);
}

fn add_u64(a: vec2<u32>, b: vec2<u32>) -> Fixed {
    let low = a.x + b.x;
    let carry = select(0u, 1u, low < a.x);
    let high = a.y + b.y;
    let sum = high + carry;
    return Fixed(vec2<u32>(low, sum), high < a.y || sum < high);
}
