//! Random numbers as a pure function of (seed, half, pixel, index, dimension): the twin of `lib/rng`, to the bit.

use glam::{DVec2, DVec4, UVec4};

use super::pcg4d::pcg4d;
use super::rng_sobol::sobol_quad;
use crate::layout::trace::SampleKey;

/// Where the random numbers of a sample come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Source {
    /// Independent numbers.
    #[default]
    Pcg,
    /// Owen-scrambled (0, 4)-sequences in base 4, stratified over the indices: of the quality of Sobol's, not his own.
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

/// Words of PCG.
pub fn random_words(key: SampleKey, dimension: u32) -> UVec4 {
    pcg4d(UVec4::new(key.pixel, key.index.wrapping_mul(2).wrapping_add(key.half), dimension, key.seed))
}

/// A number in [0, 1), a multiple of 2^-24.
pub fn unit(word: u32) -> f64 {
    f64::from(word >> 8) / f64::from(1 << 24)
}
