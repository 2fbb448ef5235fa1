//! The robust mean of one pixel.

use glam::DVec3;

use super::blocks::block_of;
use crate::cpu::film::half_mean;
use crate::layout::film::{ROBUST_BLOCKS, RobustPixel};
use crate::layout::trace::luminance;

/// Blocks that are needed to tell which of them are far from the others.
const LEAST_BLOCKS: usize = 4;

/// What a median absolute deviation is multiplied by to be a normal distribution's standard deviation.
const OF_MEDIAN: f64 = 1.4826;

/// Standard errors by which the two means of a pixel may differ.
const MOST_ERRORS: f64 = 4.0;

/// A pixel's two means, linear Rec.709.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RobustMean {
    /// Of all samples: that of the film.
    pub plain: [f64; 3],
    /// Of those blocks that were kept.
    pub robust: [f64; 3],
    /// Blocks that were left out at either end.
    pub trimmed: usize,
    /// They differ by more than the spread of the blocks explains.
    pub parts: bool,
}

/// The mean of the blocks without the darkest and the brightest, as many of each as their Gini coefficient says: none where all are alike, nearly
/// half of them where one has all the light (Buisine, Delepoulle, Renaud: Firefly Removal in Monte Carlo Rendering with Adaptive Median of meaNs,
/// 2021). None without samples.
pub fn robust_mean(pixel: &RobustPixel, exponent: i32) -> Option<RobustMean> {
    let block = |number| Block::of(half_mean(&block_of(pixel, number), exponent));
    let mut blocks: Vec<Block> = (0..ROBUST_BLOCKS as usize).map(block).collect();
    blocks.retain(|block| block.count > 0.0);
    blocks.sort_by(|a, b| a.luminance.total_cmp(&b.luminance));
    let plain = mean(&blocks)?;
    let count = blocks.len();
    let trimmed = match count < LEAST_BLOCKS {
        true => 0,
        false => ((gini(&blocks) * count as f64 / 2.0) as usize).min((count - 1) / 2),
    };
    if trimmed == 0 {
        return Some(RobustMean { plain, robust: plain, trimmed, parts: false });
    }
    let robust = mean(&blocks[trimmed..count - trimmed])?;
    let parts = (brightness(plain) - brightness(robust)).abs() > MOST_ERRORS * standard_error(&blocks);
    Some(RobustMean { plain, robust, trimmed, parts })
}

/// A block of samples.
struct Block {
    mean: [f64; 3],
    luminance: f64,
    /// Samples.
    count: f64,
}

impl Block {
    fn of((mean, count): ([f64; 3], u32)) -> Self {
        Self { mean, luminance: brightness(mean), count: count.into() }
    }
}

/// Luminance of a colour.
pub fn brightness(rgb: [f64; 3]) -> f64 {
    luminance(DVec3::from(rgb).as_vec3()).into()
}

/// Over all samples of some blocks.
fn mean(blocks: &[Block]) -> Option<[f64; 3]> {
    let count: f64 = blocks.iter().map(|block| block.count).sum();
    let sum = |c: usize| blocks.iter().map(|block| block.mean[c] * block.count).sum::<f64>();
    (count > 0.0).then(|| [0, 1, 2].map(|c| sum(c) / count))
}

/// How unequal blocks are, which are sorted: 0 where all are alike, near 1 where one has all.
fn gini(blocks: &[Block]) -> f64 {
    let count = blocks.len() as f64;
    let sum: f64 = blocks.iter().map(|block| block.luminance).sum();
    let weighted: f64 = blocks.iter().zip(1..).map(|(block, rank)| f64::from(rank) * block.luminance).sum();
    if sum > 0.0 { 2.0 * weighted / (count * sum) - (count + 1.0) / count } else { 0.0 }
}

/// That of the mean of all blocks, as the middle half of them tells it.
fn standard_error(blocks: &[Block]) -> f64 {
    let middle = median(blocks.iter().map(|block| block.luminance).collect());
    let away = median(blocks.iter().map(|block| (block.luminance - middle).abs()).collect());
    OF_MEDIAN * away / (blocks.len() as f64).sqrt()
}

/// Of at least one number.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let half = numbers.len() / 2;
    if numbers.len() % 2 == 1 { numbers[half] } else { 0.5 * (numbers[half - 1] + numbers[half]) }
}
