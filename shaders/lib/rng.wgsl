// Random numbers as a pure function of (seed, half, pixel, index, dimension).
//
// Estimators draw through sample_1d and sample_2d only, with dimension = bounce * DIMENSIONS_PER_BOUNCE + slot, so
// that another sampler can stand behind them. Two slots of one bounce are independent.

import package::gen::{SampleKey};

// PCG4D of Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
fn pcg4d(key: vec4<u32>) -> vec4<u32> {
    var v = key * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> vec4<u32>(16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Index and half together are the film sample, so the halves share no key.
fn random_words(key: SampleKey, dimension: u32) -> vec4<u32> {
    return pcg4d(vec4<u32>(key.pixel, key.index * 2u + key.half, dimension, key.seed));
}

// In [0, 1), multiples of 2^-24: exact in f32, and 1 is never reached by rounding.
fn sample_1d(key: SampleKey, dimension: u32) -> f32 {
    return f32(random_words(key, dimension).x >> 8u) * 0x1p-24;
}

// Each in [0, 1), multiples of 2^-24.
fn sample_2d(key: SampleKey, dimension: u32) -> vec2<f32> {
    return vec2<f32>(random_words(key, dimension).xy >> vec2<u32>(8u)) * 0x1p-24;
}
