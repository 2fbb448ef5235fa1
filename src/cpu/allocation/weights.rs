//! What halves of tiles tell, as how many samples the other half's tiles are to have, relative to each other.

use super::Grid;
use crate::layout::adaptive::TileTally;

/// How much of what a tile is taken to have of variance is of the tiles around it: one alone tells too little of itself, and what is rare may not have
/// been met yet. Half of it saves more than none or all.
const AROUND: f64 = 0.5;

/// A tile is to have at most so many times as many samples as the mean tile: one that met something rare is not all there is.
const MOST: f64 = 16.0;

/// And at least so many times as many, before the share that every tile has.
const LEAST: f64 = 1e-3;

/// One weight a tile, finite and above 0; `tallies` in the order of the grid. All the same where nothing is told.
///
/// The film's relMSE is the mean of variance / (n (radiance^2 + 0.01)) over pixels and channels, of n samples. For a given number of rays it is least
/// where n is proportional to the root of a sample's relative variance by its rays (Neyman 1934). Radiance is the tile's mean, not the pixel's:
/// a rare bright sample would else be measured by itself.
pub fn weights(grid: &Grid, tallies: &[TileTally]) -> Vec<f32> {
    if tallies.len() != grid.len() {
        return vec![1.0; grid.len()];
    }
    let own: Vec<f64> = tallies.iter().map(by_cost).collect();
    let around = |tile: usize| {
        let (sum, count) =
            grid.around(tile).fold((own[tile], 1u32), |(sum, count), other| (sum + own[other], count + 1));
        sum / f64::from(count)
    };
    let roots: Vec<f64> =
        (0..own.len()).map(|tile| ((1.0 - AROUND) * own[tile] + AROUND * around(tile)).sqrt()).collect();
    let mean = roots.iter().sum::<f64>() / roots.len().max(1) as f64;
    if mean <= 0.0 {
        return vec![1.0; roots.len()];
    }
    roots.iter().map(|root| (root / mean).clamp(LEAST, MOST) as f32).collect()
}

/// Relative variance by rays, both of all samples so far; all tiles have as many. 0 where it is unknown.
fn by_cost(tally: &TileTally) -> f64 {
    let by_cost = f64::from(tally.error) / f64::from(tally.rays).max(1.0);
    if by_cost.is_finite() { by_cost } else { 0.0 }
}
