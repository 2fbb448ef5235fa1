//! Weights to numbers of samples.

use super::share;
use crate::layout::film::MOST_SAMPLES;

/// How one half of a film goes on from where a round began.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Samples by tile when it began.
    pub have: Vec<u32>,
    /// What further samples are dealt by.
    pub weights: Vec<f32>,
}

impl Plan {
    /// Samples by tile where a pixel of the half has `average` of them on average: no tile has fewer than it had, nor than its [`share`]. Never
    /// fewer for a greater average, so a film that goes on is the film that was to go there at once. `pixels`: of each tile.
    ///
    /// What is dealt is rounded down, to at most `average` times all pixels.
    pub fn counts(&self, pixels: &[u32], average: u32) -> Vec<u32> {
        let tiles = || self.have.iter().zip(&self.weights).map(|(have, weight)| (*have, *weight));
        let least = share(average);
        let all: u64 = pixels.iter().map(|pixels| u64::from(*pixels) * u64::from(average)).sum();
        let fits = |level: f32| {
            let dealt =
                tiles().zip(pixels).map(|(tile, pixels)| u64::from(count(tile, least, level)) * u64::from(*pixels));
            dealt.sum::<u64>() <= all
        };
        // The greatest level that fits: floats that are not negative are ordered as their bits are.
        let (mut low, mut high) = (0, f32::MAX.to_bits());
        while low < high {
            let middle = low + (high - low).div_ceil(2);
            if fits(f32::from_bits(middle)) {
                low = middle;
            } else {
                high = middle - 1;
            }
        }
        tiles().map(|tile| count(tile, least, f32::from_bits(low))).collect()
    }
}

/// Samples of a tile where those of weight 1 have `level`.
fn count((have, weight): (u32, f32), least: u32, level: f32) -> u32 {
    let dealt = (level * weight + 0.5) as u32;
    have.max(least).max(dealt.min(MOST_SAMPLES / 2))
}
