//! Where two pictures differ by more than their noise: means and z-scores of blocks of pixels. Knows no files.
//!
//! Pictures carry no variance, so that of a block's mean difference is estimated from the spread of A - B over its pixels,
//! and is never taken to be below that of the blocks around it: a block that a rare bright sample happened to miss looks
//! quieter than it is. Where the noise of neighbouring pixels is alike, as it is where paths are reused within tiles, that is
//! corrected for (`alike`). A difference in structure within a block adds to the spread, so it makes z smaller, not larger.

use super::alike::common_noise;
use super::metrics::{Sample, comparable};
use glam::UVec2;

/// Probability that any block of two pictures of equal expectation is beyond the limit.
pub const FAMILY_WISE: f64 = 1e-4;

/// Pixels of a block below which its spread says too little.
pub const LEAST_PIXELS: u32 = 32;

/// Part of the mean by which rounding alone may move one of two pictures.
pub const ROUNDING: f64 = 1e-5;

/// Part of the picture's mean below which a block counts as black.
pub const BLACK: f64 = 1e-3;

/// Standard errors are 0 where all pixels of a block differ by the same; z is held within this.
const MOST: f64 = 1e6;

/// A picture cut into blocks of nearly equal size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Of the picture, pixels.
    pub size: UVec2,
    /// Blocks in x and y.
    pub count: UVec2,
}

impl Grid {
    /// Blocks of about `side` x `side` pixels, at least one.
    pub fn new(size: UVec2, side: u32) -> Self {
        let side = side.max(1);
        let count = |pixels: u32| (pixels.saturating_add(side / 2) / side).max(1);
        Self { size, count: UVec2::new(count(size.x), count(size.y)) }
    }

    /// First pixel of the block `index` on an axis of `pixels` cut into `count`.
    fn start(index: u32, pixels: u32, count: u32) -> u32 {
        let at = u64::from(index) * u64::from(pixels) / u64::from(count.max(1));
        u32::try_from(at).expect("invariant: within the picture")
    }

    /// First pixel of a block, and the one behind its last.
    pub fn bounds(&self, block: UVec2) -> (UVec2, UVec2) {
        let at = |block: UVec2| {
            UVec2::new(Self::start(block.x, self.size.x, self.count.x), Self::start(block.y, self.size.y, self.count.y))
        };
        (at(block), at(block + 1))
    }
}

/// One block, over the pixels that are good in both pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// First pixel.
    pub min: UVec2,
    /// The pixel behind the last.
    pub max: UVec2,
    /// Pixels compared.
    pub pixels: u32,
    /// Mean of A, by channel.
    pub mean_a: [f64; 3],
    /// Mean of B, by channel.
    pub mean_b: [f64; 3],
    /// Variance of A - B over the pixels, by channel.
    pub variance: [f64; 3],
    /// Mean difference in standard errors, by channel; positive where A is brighter. `None` for fewer than
    /// [`LEAST_PIXELS`].
    pub z: Option<[f64; 3]>,
    /// Mean over channels of A by that of B, minus 1; infinite where only B is black.
    pub relative: f64,
}

impl Block {
    /// The z of the channel where it is largest, and that channel.
    pub fn worst(&self) -> Option<(f64, usize)> {
        self.z.map(largest)
    }
}

/// The blocks of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    pub grid: Grid,
    /// Row by row.
    pub list: Vec<Block>,
    /// z of the whole picture by channel, from the errors of its blocks; `None` where no block has one.
    pub whole: Option<[f64; 3]>,
    /// |z| that pictures of equal expectation pass anywhere with probability [`FAMILY_WISE`]; `None` without any z.
    pub limit: Option<f64>,
    /// By how much the variance of means is more than if the noise of each pixel were independent, by channel.
    pub common_noise: [f64; 3],
}

impl Blocks {
    /// Cuts and compares two pictures of the grid's size, row by row from the top.
    pub fn of<A: Sample, B: Sample>(a: &[[A; 3]], b: &[[B; 3]], grid: Grid) -> Self {
        assert!(a.len() == b.len() && a.len() == grid.size.x as usize * grid.size.y as usize, "invariant: one size");
        let mut list = Vec::with_capacity((grid.count.x * grid.count.y) as usize);
        for y in 0..grid.count.y {
            list.extend((0..grid.count.x).map(|x| summed(a, b, &grid, UVec2::new(x, y))));
        }
        let common_noise = common_noise(a, b, grid.size);
        let mut blocks = Self { grid, list, whole: None, limit: None, common_noise };
        blocks.score();
        blocks.relate();
        blocks
    }

    /// The block that a pixel is in.
    pub fn block_of(&self, pixel: UVec2) -> &Block {
        let Grid { size, count } = self.grid;
        let index = |pixel: u32, size: u32, count: u32| {
            // The last block that begins at or before the pixel: the inverse of `start`.
            let index = ((u64::from(pixel) + 1) * u64::from(count) - 1) / u64::from(size.max(1));
            usize::try_from(index).expect("invariant: within the grid")
        };
        &self.list[index(pixel.y, size.y, count.y) * count.x as usize + index(pixel.x, size.x, count.x)]
    }

    /// Blocks with a channel beyond the limit.
    pub fn beyond(&self) -> usize {
        let beyond =
            |block: &&Block| matches!((block.worst(), self.limit), (Some((z, _)), Some(limit)) if z.abs() > limit);
        self.list.iter().filter(beyond).count()
    }

    /// The block with the largest |z|.
    pub fn worst(&self) -> Option<&Block> {
        let size = |block: &Block| block.worst().map_or(-1.0, |(z, _)| z.abs());
        self.list.iter().filter(|block| block.z.is_some()).max_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The block with the largest relative difference.
    pub fn most_different(&self) -> Option<&Block> {
        let compared = self.list.iter().filter(|block| block.pixels > 0);
        compared.max_by(|a, b| a.relative.abs().total_cmp(&b.relative.abs()))
    }

    /// The largest |z| of the whole picture and all blocks.
    pub fn largest_z(&self) -> Option<f64> {
        let block = self.worst().and_then(Block::worst);
        let whole = self.whole.map(largest);
        block.into_iter().chain(whole).map(|(z, _)| z.abs()).reduce(f64::max)
    }

    /// Variance of the differences in a block, and at least that in it and those around it together.
    fn cautious_variance(&self, block: usize, channel: usize) -> f64 {
        let count = self.grid.count;
        let (x, y) = (block as u32 % count.x, block as u32 / count.x);
        let (mut pixels, mut squares) = (0.0, 0.0);
        for y in y.saturating_sub(1)..(y + 2).min(count.y) {
            for x in x.saturating_sub(1)..(x + 2).min(count.x) {
                let near = &self.list[(y * count.x + x) as usize];
                pixels += f64::from(near.pixels);
                squares += f64::from(near.pixels) * near.variance[channel];
            }
        }
        self.list[block].variance[channel].max(squares / f64::max(pixels, 1.0))
    }

    fn score(&mut self) {
        let (mut pixels, mut difference, mut reference, mut variance) = (0.0, [0.0; 3], [0.0; 3], [0.0; 3]);
        let mut least = u32::MAX;
        for index in 0..self.list.len() {
            let block = self.list[index];
            if block.pixels < LEAST_PIXELS {
                continue;
            }
            least = least.min(block.pixels);
            let n = f64::from(block.pixels);
            let spread: [f64; 3] = std::array::from_fn(|c| self.common_noise[c] * self.cautious_variance(index, c));
            let z = std::array::from_fn(|c| {
                difference[c] += n * (block.mean_a[c] - block.mean_b[c]);
                reference[c] += n * block.mean_b[c];
                variance[c] += n * spread[c];
                score(block.mean_a[c] - block.mean_b[c], block.mean_b[c], spread[c] / n)
            });
            pixels += n;
            self.list[index].z = Some(z);
        }
        if pixels > 0.0 {
            let whole = |c: usize| score(difference[c] / pixels, reference[c] / pixels, variance[c] / pixels.powi(2));
            self.whole = Some(std::array::from_fn(whole));
            let scored = self.list.iter().filter(|block| block.z.is_some()).count();
            self.limit = Some(limit(3 * (scored + 1), least - 1));
        }
    }

    fn relate(&mut self) {
        let brightness = |mean: &[f64; 3]| mean.iter().sum::<f64>() / 3.0;
        let pixels: f64 = self.list.iter().map(|block| f64::from(block.pixels)).sum();
        let total: f64 = self.list.iter().map(|block| f64::from(block.pixels) * brightness(&block.mean_b)).sum();
        let floor = BLACK * total / f64::max(pixels, 1.0);
        for block in &mut self.list {
            let (a, b) = (brightness(&block.mean_a), brightness(&block.mean_b));
            block.relative = if a == b { 0.0 } else { (a - b) / b.max(floor) };
        }
    }
}

/// The largest by size, and where it is.
fn largest(z: [f64; 3]) -> (f64, usize) {
    let channel = (1..3).fold(0, |best, c| if z[c].abs() > z[best].abs() { c } else { best });
    (z[channel], channel)
}

/// A mean difference in standard errors, less what rounding explains.
fn score(difference: f64, reference: f64, variance: f64) -> f64 {
    let beyond = (difference.abs() - ROUNDING * reference).max(0.0);
    if beyond == 0.0 { 0.0 } else { (beyond / variance.sqrt()).min(MOST).copysign(difference) }
}

/// Sums over one block.
fn summed<A: Sample, B: Sample>(a: &[[A; 3]], b: &[[B; 3]], grid: &Grid, block: UVec2) -> Block {
    let (min, max) = grid.bounds(block);
    let (mut pixels, mut sum_a, mut sum_b) = (0u32, [0.0; 3], [0.0; 3]);
    let each = |visit: &mut dyn FnMut([f64; 3], [f64; 3])| {
        for y in min.y..max.y {
            let row = y as usize * grid.size.x as usize;
            let columns = row + min.x as usize..row + max.x as usize;
            for (a, b) in a[columns.clone()].iter().zip(&b[columns]).filter(|(a, b)| comparable(**a, **b)) {
                visit(a.map(Into::into), b.map(Into::into));
            }
        }
    };
    each(&mut |a, b| {
        pixels += 1;
        for c in 0..3 {
            sum_a[c] += a[c];
            sum_b[c] += b[c];
        }
    });
    let n = f64::from(pixels.max(1));
    let (mean_a, mean_b) = (sum_a.map(|sum| sum / n), sum_b.map(|sum| sum / n));
    let mut squares = [0.0; 3];
    each(&mut |a, b| {
        for c in 0..3 {
            squares[c] += (a[c] - b[c] - (mean_a[c] - mean_b[c])).powi(2);
        }
    });
    let variance = squares.map(|sum| sum / f64::from(pixels.saturating_sub(1).max(1)));
    Block { min, max, pixels, mean_a, mean_b, variance, z: None, relative: 0.0 }
}

/// What the largest of `tests` scores with `freedom` degrees of freedom passes with probability [`FAMILY_WISE`]: Bonferroni's
/// bound, two-sided, by Student's distribution (Abramowitz and Stegun 1964, 26.2.23 and 26.7.5).
pub fn limit(tests: usize, freedom: u32) -> f64 {
    let t = (-2.0 * (FAMILY_WISE / 2.0 / tests.max(1) as f64).ln()).sqrt();
    let numerator = 2.515517 + t * (0.802853 + t * 0.010328);
    let z = t - numerator / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    let s = z * z;
    let terms = [
        z * (s + 1.0) / 4.0,
        z * (s * (5.0 * s + 16.0) + 3.0) / 96.0,
        z * (s * (s * (3.0 * s + 19.0) + 17.0) - 15.0) / 384.0,
        z * (s * (s * (s * (79.0 * s + 776.0) + 1482.0) - 1920.0) - 945.0) / 92_160.0,
    ];
    let n = f64::from(freedom.max(1));
    terms.iter().rev().fold(0.0, |sum, term| (sum + term) / n) + z
}
