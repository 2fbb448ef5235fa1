// Independent random numbers by hashing the key.

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
fn pcg_words(key: SampleKey, dimension: u32) -> vec4<u32> {
    return pcg4d(vec4<u32>(key.pixel, key.index * 2u + key.half, dimension, key.seed));
}
