//! Owen-scrambled sequences in groups of four dimensions: the twin of `lib/rng_sobol`, to the bit, written from the field's
//! multiplication table and the binomials, digit by digit.

use glam::UVec4;

use super::pcg4d::pcg4d;
use crate::layout::trace::SampleKey;

/// Sets these hashes off from those that the PCG sampler makes of equal keys.
const STREAM: u32 = 0x536f_626f;

/// A nested uniform scramble of a number whose lowest bit counts most: the Laine-Karras hash in Vegdahl's form ("Building
/// a Better LK Hash", 2021).
pub fn owen_scramble(reversed: u32, key: u32) -> u32 {
    let mut x = reversed ^ reversed.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(key).wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The words of the four dimensions of `dimension`'s group: numbers in [0, 1) are their highest bits.
pub fn sobol_quad(key: SampleKey, dimension: u32) -> [u32; 4] {
    let group = (dimension >> 2).wrapping_mul(2).wrapping_add(key.half);
    let words = pcg4d(UVec4::new(key.pixel, group, key.seed, STREAM)).to_array().map(stir);
    let shuffle = words.into_iter().fold(0u32, u32::wrapping_add);
    let reversed = owen_scramble(key.index.reverse_bits(), shuffle) ^ owen_scramble(0, shuffle);
    let points = points(reversed.reverse_bits());
    [0, 1, 2, 3].map(|i| owen_scramble(points[i], words[i]).reverse_bits())
}

/// Spreads a word's high bits over its low ones.
fn stir(word: u32) -> u32 {
    let word = (word ^ (word >> 16)).wrapping_mul(0x7feb_352d);
    word ^ (word >> 15)
}

/// Point `index` of the (0, 4)-sequence in base 4 before scrambling, the lowest bit counting most.
fn points(index: u32) -> [u32; 4] {
    let bits = |digits: [u32; 16]| digits.iter().enumerate().fold(0, |word, (i, digit)| word | digit << (2 * i));
    // In the first and the last dimension a digit begins with the sum of both bits.
    let summed = |digits: [u32; 16]| digits.map(|digit| digit ^ (digit >> 1));
    let [zero, one, w, w2] = [0, 1, 2, 3].map(|element| generate(index, element));
    [bits(summed(zero)), bits(one), bits(w), bits(summed(w2))]
}

/// The sums over j of (j over i) element^(j - i) a_j, a_j being the index's base-4 digits as elements of the field.
fn generate(index: u32, element: u32) -> [u32; 16] {
    std::array::from_fn(|i| {
        let mut sum = 0;
        let mut power = 1;
        // Up to the highest digit of the index.
        let digits = (32 - index.leading_zeros() as usize).div_ceil(2);
        for j in i..digits {
            // The binomial is odd where i has no bit that j lacks (Lucas).
            if i & !j == 0 {
                sum ^= multiply(power, index >> (2 * j) & 3);
            }
            power = multiply(power, element);
        }
        sum
    })
}

/// The product in the field of four elements: 0, 1, w = 2, w + 1 = 3.
fn multiply(a: u32, b: u32) -> u32 {
    if a == 0 || b == 0 { 0 } else { (a + b - 2) % 3 + 1 }
}
