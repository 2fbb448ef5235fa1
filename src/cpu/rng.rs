//! Random numbers as a pure function of (seed, half, pixel, index, dimension): the twin of `lib/rng`, to the bit.

use glam::{DVec2, DVec4, UVec4};

use super::rng_sobol::sobol_quad;
use crate::layout::trace::SampleKey;

/// Where the random numbers of a sample come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Source {
    /// Independent numbers.
    #[default]
    Pcg,
    /// Owen-scrambled sequences, stratified over the indices.
    Sobol,
}

impl Source {
    /// In [0, 1), a multiple of 2^-24.
    pub fn sample_1d(self, key: SampleKey, dimension: u32) -> f64 {
        match self {
            Source::Pcg => sample_1d(key, dimension),
            Source::Sobol => unit(sobol_quad(key, dimension)[(dimension & 3) as usize]),
        }
    }

    /// Each in [0, 1), a multiple of 2^-24. `dimension` is even.
    pub fn sample_2d(self, key: SampleKey, dimension: u32) -> DVec2 {
        match self {
            Source::Pcg => sample_2d(key, dimension),
            Source::Sobol => {
                let drawn = sobol_quad(key, dimension).map(unit);
                if dimension & 2 == 0 { DVec2::new(drawn[0], drawn[1]) } else { DVec2::new(drawn[2], drawn[3]) }
            }
        }
    }

    /// Each in [0, 1), a multiple of 2^-24. `dimension` is a multiple of 4.
    pub fn sample_4d(self, key: SampleKey, dimension: u32) -> DVec4 {
        let words = match self {
            Source::Pcg => random_words(key, dimension).to_array(),
            Source::Sobol => sobol_quad(key, dimension),
        };
        DVec4::from_array(words.map(unit))
    }
}

/// PCG4D of Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
pub fn pcg4d(key: UVec4) -> UVec4 {
    let mut v = key.to_array().map(|w| w.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    stir(&mut v);
    v = v.map(|w| w ^ (w >> 16));
    stir(&mut v);
    UVec4::from_array(v)
}

fn stir(v: &mut [u32; 4]) {
    v[0] = v[0].wrapping_add(v[1].wrapping_mul(v[3]));
    v[1] = v[1].wrapping_add(v[2].wrapping_mul(v[0]));
    v[2] = v[2].wrapping_add(v[0].wrapping_mul(v[1]));
    v[3] = v[3].wrapping_add(v[1].wrapping_mul(v[2]));
}

/// The key of a film sample: even ones belong to half 0, odd ones to half 1.
pub fn sample_key(pixel: u32, sample: u32, seed: u32) -> SampleKey {
    SampleKey { pixel, index: sample >> 1, half: sample & 1, seed }
}

/// By PCG. In [0, 1), a multiple of 2^-24.
pub fn sample_1d(key: SampleKey, dimension: u32) -> f64 {
    unit(random_words(key, dimension).x)
}

/// By PCG. Each in [0, 1), a multiple of 2^-24.
pub fn sample_2d(key: SampleKey, dimension: u32) -> DVec2 {
    let words = random_words(key, dimension);
    DVec2::new(unit(words.x), unit(words.y))
}

fn random_words(key: SampleKey, dimension: u32) -> UVec4 {
    pcg4d(UVec4::new(key.pixel, key.index.wrapping_mul(2).wrapping_add(key.half), dimension, key.seed))
}

fn unit(word: u32) -> f64 {
    f64::from(word >> 8) / f64::from(1 << 24)
}
