// Random numbers as a pure function of (seed, half, pixel, index, dimension).
//
// Estimators draw through these functions only, with dimension = bounce * DIMENSIONS_PER_BOUNCE + slot, so that another
// sampler can stand behind them. Numbers are in [0, 1), multiples of 2^-24: exact in f32, and 1 is never reached by
// rounding. A 2D draw starts at an even dimension, a 4D draw at a multiple of 4.

import package::gen::{SampleKey};
@if(!sobol) import package::lib::rng_pcg::{pcg_words};
@if(sobol) import package::lib::rng_sobol::{sobol_pair, sobol_quad, sobol_word};

fn sample_1d(key: SampleKey, dimension: u32) -> f32 {
    @if(sobol) {
        return f32(sobol_word(key, dimension) >> 8u) * 0x1p-24;
    } @else {
        return f32(pcg_words(key, dimension).x >> 8u) * 0x1p-24;
    }
}

fn sample_2d(key: SampleKey, dimension: u32) -> vec2<f32> {
    @if(sobol) {
        return vec2<f32>(sobol_pair(key, dimension) >> vec2<u32>(8u)) * 0x1p-24;
    } @else {
        return vec2<f32>(pcg_words(key, dimension).xy >> vec2<u32>(8u)) * 0x1p-24;
    }
}

// What sample_1d gives for the four dimensions, or sample_2d for each two; by PCG, other numbers than those.
fn sample_4d(key: SampleKey, dimension: u32) -> vec4<f32> {
    @if(sobol) {
        return vec4<f32>(sobol_quad(key, dimension) >> vec4<u32>(8u)) * 0x1p-24;
    } @else {
        return vec4<f32>(pcg_words(key, dimension) >> vec4<u32>(8u)) * 0x1p-24;
    }
}
