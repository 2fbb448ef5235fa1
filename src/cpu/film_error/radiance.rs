//! By what the error of a pixel is made relative: 1 / (radiance^2 + 0.01), of a radiance that nobody knows.
//!
//! The pixel's own mean is no good where it is noisy: a rare bright sample would be measured by itself. The mean of the pixels around it is no
//! good at an edge. So the weight is between the weights of both, after Wiener: as much of the first as structure has of structure and noise
//! together. Noise is what the halves do not agree on, structure what they agree on: the product of how far each is from what is around.
//! Where one half alone has met what an edge brings, the pixel is as those along the edge are (`line`).

use std::ops::Range;

use super::around::sums;
use super::halves::Halves;
use super::line::along_edge;
use crate::stats::metrics::DARK;

/// Pixels on every side that are around one.
const AROUND: usize = 2;

/// Pixels on every side whose noise tells what that of those around one is at least: where rare bright samples make it, many have none yet.
const WIDE: usize = 4;

/// How much of it.
const AT_LEAST: f64 = 0.5;

/// Pixels on every side over which structure is averaged.
const STRUCTURE: usize = 1;

/// Pixels on every side on which a weight depends.
pub const REACH: usize = WIDE + STRUCTURE;

/// What a pixel adds to the film's relMSE.
#[derive(Clone, Copy, Debug, Default)]
pub struct Share {
    /// Relative errors of the channels, with signs.
    pub errors: [f64; 3],
    /// What their squares might sum up to.
    pub most: f64,
    /// False where it has no samples in both halves.
    pub is_there: bool,
}

/// The pixels around one.
#[derive(Clone, Copy, Debug, Default)]
struct Around {
    /// Of each half.
    means: [[f64; 3]; 2],
    /// Variance of the mean of both.
    variance: [f64; 3],
    is_there: bool,
}

/// The shares of some rows. Those of the film within [`REACH`] of them are there too.
pub fn shares(halves: &[Halves], width: usize, rows: Range<usize>) -> Vec<Share> {
    // Structure of the rows beside them is needed as well.
    let wider = near_rows(&rows, halves.len() / width);
    let around = around(halves, width, wider.clone());
    let inner = &halves[wider.start * width..wider.end * width];
    let products: Vec<[f64; 4]> = inner.iter().zip(&around).map(|(pixel, around)| product(pixel, around)).collect();
    let skipped = rows.start - wider.start;
    let structure = sums(&products, width, skipped..skipped + rows.len(), STRUCTURE);
    let pixels = halves[rows.start * width..rows.end * width].iter().zip(&around[skipped * width..]);
    pixels
        .zip(structure)
        .enumerate()
        .map(|(i, ((pixel, around), [r, g, b, count]))| {
            let structure = [r, g, b].map(|sum| if count > 0.0 { (sum / count).max(0.0) } else { 0.0 });
            let at = (i % width, rows.start + i / width);
            share(pixel, around, structure, |c| along_edge(halves, width, at, c))
        })
        .collect()
}

fn near_rows(rows: &Range<usize>, height: usize) -> Range<usize> {
    rows.start.saturating_sub(STRUCTURE)..(rows.end + STRUCTURE).min(height)
}

/// What is around each pixel of some rows, without itself: so no pixel's noise is in what it is measured by.
fn around(halves: &[Halves], width: usize, rows: Range<usize>) -> Vec<Around> {
    let means: Vec<[f64; 6]> = halves.iter().map(both_means).collect();
    let noise: Vec<[f64; 4]> = halves.iter().map(noise_and_one).collect();
    let means_around = without_own(&means, width, rows.clone(), AROUND);
    let noise_around = without_own(&noise, width, rows.clone(), AROUND);
    let noise_wide = without_own(&noise, width, rows, WIDE);
    let joined = means_around.into_iter().zip(noise_around).zip(noise_wide);
    joined.map(|((means, near), wide)| Around::of(means, near, wide)).collect()
}

/// For each pixel of some rows, the sum over those within reach but not itself.
fn without_own<const N: usize>(values: &[[f64; N]], width: usize, rows: Range<usize>, reach: usize) -> Vec<[f64; N]> {
    let own = &values[rows.start * width..rows.end * width];
    let mut all = sums(values, width, rows.clone(), reach);
    for (sum, own) in all.iter_mut().zip(own) {
        sum.iter_mut().zip(own).for_each(|(sum, own)| *sum -= own);
    }
    all
}

fn both_means(pixel: &Halves) -> [f64; 6] {
    let [[a, b, c], [d, e, f]] = pixel.means;
    [a, b, c, d, e, f]
}

/// The variance of the channels' mean, and 1.
fn noise_and_one(pixel: &Halves) -> [f64; 4] {
    let [r, g, b] = [0, 1, 2].map(|c| pixel.error(c).powi(2));
    [r, g, b, if pixel.is_there() { 1.0 } else { 0.0 }]
}

impl Around {
    /// From sums over pixels: of the means, of the noise and their number, and of these in a wider square.
    fn of(means: [f64; 6], near: [f64; 4], wide: [f64; 4]) -> Self {
        let (count, more) = (near[3], wide[3]);
        if count < 0.5 {
            return Self::default();
        }
        let half = |first: usize| std::array::from_fn(|c| means[first + c] / count);
        let noise = |c: usize| (near[c] / count).max(AT_LEAST * wide[c] / more);
        Self { means: [half(0), half(3)], variance: [0, 1, 2].map(|c| noise(c) / count), is_there: true }
    }
}

/// What both halves agree that the pixel has more than those around it, squared; and 1.
fn product(pixel: &Halves, around: &Around) -> [f64; 4] {
    if !(pixel.is_there() && around.is_there) {
        return [0.0; 4];
    }
    let more = |half: usize, c: usize| pixel.means[half][c] - around.means[half][c];
    let [r, g, b] = [0, 1, 2].map(|c| more(0, c) * more(1, c));
    [r, g, b, 1.0]
}

/// `along_edge`: what a channel has along the edge that the pixel is at.
fn share(pixel: &Halves, around: &Around, structure: [f64; 3], along_edge: impl Fn(usize) -> f64) -> Share {
    if !pixel.is_there() {
        return Share::default();
    }
    let weights = [0, 1, 2].map(|c| weights(pixel, around, structure[c], c, || along_edge(c)));
    Share {
        errors: [0, 1, 2].map(|c| weights[c].0.sqrt() * pixel.error(c)),
        most: (0..3).map(|c| weights[c].1 * pixel.error(c).powi(2)).sum(),
        is_there: true,
    }
}

/// The weight of a channel's squared error, and the greater one of the two that it is between.
///
/// An edge counts for the weight alone: that what lies along it is the pixel's is as good a guess as there is, and not sure.
fn weights(pixel: &Halves, around: &Around, structure: f64, c: usize, along_edge: impl Fn() -> f64) -> (f64, f64) {
    let own = own_weight(pixel, c, 0.0);
    if !around.is_there {
        return (own, own);
    }
    let mean = 0.5 * (around.means[0][c] + around.means[1][c]);
    // Of a mean of variance v, 1 / mean^2 is too large by 3 v / mean^2 parts, to first order.
    let others = 1.0 / (mean * mean + DARK + 3.0 * around.variance[c]);
    let noise = pixel.error(c).powi(2);
    let trust = if structure > 0.0 { structure / (structure + noise) } else { 0.0 };
    let likely = if trust > 0.0 { own_weight(pixel, c, along_edge()) } else { own };
    (trust * likely + (1.0 - trust) * others, own.max(others))
}

/// By the pixel alone. The product of the halves and not the square of their mean: it is the square of the radiance on average, and is not
/// deceived by what is bright in one half alone. Where that is nearly all there is, the pixel is likely to be darker still; but not darker than
/// `least`, as far as its own mean goes.
fn own_weight(pixel: &Halves, c: usize, least: f64) -> f64 {
    let [a, b] = pixel.means.map(|mean| mean[c]);
    let mean = 0.5 * (a + b);
    let dark = a.min(b).max(least.min(mean)).hypot(DARK.sqrt());
    let rare = 1.0 + pixel.error(c).powi(2) / (mean * mean + DARK);
    rare / (dark * (dark + (a - b).abs()))
}
