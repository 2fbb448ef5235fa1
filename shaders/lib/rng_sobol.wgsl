// Owen-scrambled digital sequences in groups of four dimensions, after Burley, "Practical Hash-based Owen Scrambling",
// JCGT 9(4), 2020: within a group a sample is stratified, and a shuffle of the indices sets each group off from all others.
//
// The sequence of a group is not Sobol's own but the (0, 4)-sequence of Faure (1982) and Niederreiter (1987) over the field of
// four elements, whose digits are pairs of bits: of any 4^n samples one lies in each box of 4^-n of the unit cube that is
// cut along powers of 4. The first two dimensions, and the last two, are besides (0, 2)-sequences in base 2, as Sobol's first
// two are. It needs no table and no loop. An aligned pair is what a 2D draw takes; 4^n samples stratify both pairs jointly.

import package::gen::{SampleKey};
import package::lib::rng_pcg::{pcg4d};

// Of every pair of bits the lower.
const LOW_BITS: u32 = 0x55555555u;

// Sets these hashes off from those that the PCG sampler makes of equal keys.
const SOBOL_STREAM: u32 = 0x536f626fu;

// Index and scrambles of a group.
struct SobolGroup {
    // Shuffled.
    index: u32,
    // A key for each dimension.
    scrambles: vec4<u32>,
}

// A nested uniform scramble of a number whose lowest bit counts most: each bit is flipped or not by a hash of those below it.
// The Laine-Karras hash in Vegdahl's form ("Building a Better LK Hash", 2021).
fn owen_scramble(reversed: u32, key: u32) -> u32 {
    var x = reversed ^ (reversed * 0x3d20adeau);
    x += key;
    x *= (key >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// A digital shift of the indices shifts the points, which the scrambles absorb: so 0 may stay 0, and then every index keeps
// its highest bit, and the first 2^n remain the first.
fn sobol_group(key: SampleKey, dimension: u32) -> SobolGroup {
    var words = pcg4d(vec4<u32>(key.pixel, (dimension >> 2u) * 2u + key.half, key.seed, SOBOL_STREAM));
    // PCG leaves neighbouring pixels alike in its low bits, and the lowest of a key flips half of the range.
    words = (words ^ (words >> vec4<u32>(16u))) * 0x7feb352du;
    words ^= words >> vec4<u32>(15u);
    // Independent of any three of the words.
    let shuffle = words.x + words.y + words.z + words.w;
    let reversed = owen_scramble(reverseBits(key.index), shuffle) ^ owen_scramble(0u, shuffle);
    return SobolGroup(reverseBits(reversed), words);
}

// Products by an element of the field {0, 1, w, w + 1}, w^2 = w + 1, digit by digit; a digit's lower bit counts ones, its
// higher w.
fn times_w(digits: u32) -> u32 {
    let low = digits & LOW_BITS;
    let high = (digits >> 1u) & LOW_BITS;
    return high | ((low ^ high) << 1u);
}

fn times_w2(digits: u32) -> u32 {
    let low = digits & LOW_BITS;
    let high = (digits >> 1u) & LOW_BITS;
    return (low ^ high) | (low << 1u);
}

// The Pascal matrix of binomials (j over i) on base-4 digits. By Lucas's theorem it is a Kronecker product of 2x2 matrices, a
// step each.
fn pascal(index: u32) -> u32 {
    var v = index ^ ((index >> 2u) & 0x33333333u);
    v ^= (v >> 4u) & 0x0f0f0f0fu;
    v ^= (v >> 8u) & 0x00ff00ffu;
    return v ^ (v >> 16u);
}

// The same of (j over i) w^(j - i): w squared is w + 1, and that squared w.
fn pascal_w(index: u32) -> u32 {
    var v = index ^ times_w((index >> 2u) & 0x33333333u);
    v ^= times_w2((v >> 4u) & 0x0f0f0f0fu);
    v ^= times_w((v >> 8u) & 0x00ff00ffu);
    return v ^ times_w2(v >> 16u);
}

// Makes the first bit of every digit the sum of both.
fn sum_digits(word: u32) -> u32 {
    return word ^ ((word >> 1u) & LOW_BITS);
}

// The first two dimensions before scrambling, lowest bit first. That a digit begins with low ^ high in one and with low in the
// other is what makes them a (0, 2)-sequence in base 2.
fn first_pair(index: u32) -> vec2<u32> {
    return vec2<u32>(sum_digits(index), pascal(index));
}

// The last two. In the other order than above: the film against a light is better stratified so.
fn last_pair(index: u32) -> vec2<u32> {
    let word = pascal_w(index);
    return vec2<u32>(word, sum_digits(pascal(word)));
}

fn sobol_word(key: SampleKey, dimension: u32) -> u32 {
    let drawn = sobol_pair(key, dimension & ~1u);
    return select(drawn.x, drawn.y, (dimension & 1u) != 0u);
}

fn sobol_pair(key: SampleKey, dimension: u32) -> vec2<u32> {
    let group = sobol_group(key, dimension);
    var pair = first_pair(group.index);
    var scrambles = group.scrambles.xy;
    if ((dimension & 2u) != 0u) {
        pair = last_pair(group.index);
        scrambles = group.scrambles.zw;
    }
    return reverseBits(vec2<u32>(owen_scramble(pair.x, scrambles.x), owen_scramble(pair.y, scrambles.y)));
}

fn sobol_quad(key: SampleKey, dimension: u32) -> vec4<u32> {
    let group = sobol_group(key, dimension);
    let points = vec4<u32>(first_pair(group.index), last_pair(group.index));
    let keys = group.scrambles;
    return reverseBits(vec4<u32>(
        owen_scramble(points.x, keys.x),
        owen_scramble(points.y, keys.y),
        owen_scramble(points.z, keys.z),
        owen_scramble(points.w, keys.w),
    ));
}
