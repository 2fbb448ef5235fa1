// Another sampler in the place of the shipped one: a lattice in four dimensions, shifted at random, after Roberts, "The Unreasonable
// Effectiveness of Quasirandom Sequences" (2018): multiples of the powers of 1 / g, where g^5 = g + 1. Each group of four dimensions has
// its own shift, and its own order of the samples.

import package::gen::{SampleKey};
import package::lib::rng_pcg::{pcg4d};

// Parts of 2^32: g^-1, g^-2, g^-3, g^-4 with g = 1.1673039782614187.
const STEPS: vec4<u32> = vec4<u32>(3679390609u, 3152041523u, 2700274805u, 2313257605u);

// Sets these hashes off from those of other samplers.
const LATTICE_STREAM: u32 = 0x6c617474u;

// The words of a group that holds `dimension`.
fn lattice(key: SampleKey, dimension: u32) -> vec4<u32> {
    let group = (dimension >> 2u) * 2u + key.half;
    let shift = pcg4d(vec4<u32>(key.pixel, group, key.seed, LATTICE_STREAM));
    // Aligned runs of 16 samples stay together, in another order.
    let order = pcg4d(vec4<u32>(group, key.seed, LATTICE_STREAM, 1u));
    let index = key.index ^ (order.x & 15u);
    return shift + index * STEPS;
}

fn sobol_word(key: SampleKey, dimension: u32) -> u32 {
    return lattice(key, dimension)[dimension & 3u];
}

fn sobol_pair(key: SampleKey, dimension: u32) -> vec2<u32> {
    let words = lattice(key, dimension);
    return select(words.xy, words.zw, (dimension & 2u) != 0u);
}

fn sobol_quad(key: SampleKey, dimension: u32) -> vec4<u32> {
    return lattice(key, dimension);
}
