// Floats as unsigned integers of the same order, for atomic minima and maxima.

// Keeps the order of all finite numbers (-0 lies just below +0). Never 0, nor all ones, for a finite number.
fn ordered_bits(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

// The inverse of ordered_bits.
fn from_ordered_bits(key: u32) -> f32 {
    return bitcast<f32>(select(~key, key & 0x7fffffffu, (key & 0x80000000u) != 0u));
}

// Three words of `centroid_bounds` that hold a greatest corner.
fn greatest_corner(words: vec3<u32>) -> vec3<f32> {
    return vec3<f32>(from_ordered_bits(words.x), from_ordered_bits(words.y), from_ordered_bits(words.z));
}

// Three words of `centroid_bounds` that hold a least corner: complemented, so that the least is the greatest word.
fn least_corner(words: vec3<u32>) -> vec3<f32> {
    return greatest_corner(~words);
}
