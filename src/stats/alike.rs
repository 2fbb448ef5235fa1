//! How alike the noise of neighbouring pixels is. Where paths are reused within tiles, pixels share their errors, and a mean over many is less
//! certain than their spread says.

use glam::UVec2;

use super::metrics::{Sample, comparable};

/// Side of a cell, pixels: that of the blocks of pixels which share paths.
const CELL: u32 = 8;

/// Pairs of cells below which nothing is said.
const LEAST_PAIRS: usize = 100;

/// Below this it is no more than chance that cells vary more than independent pixels would have them.
const LEAST_FACTOR: f64 = 2.0;

/// Median of the square of a normal variable of variance 1.
const MEDIAN_SQUARE: f64 = 0.4549;

/// By how much the variance of means over many pixels is more than if the noise of each were independent, by channel; 1 where that can't be told
/// from chance.
///
/// By the differences of neighbouring cells' means, so that what changes slowly over the picture is no noise; and by their median, so that a
/// place where two pictures really differ is none either. Cells need not lie on those that share paths: half of a tile's pixels in a cell show.
pub fn common_noise<A: Sample, B: Sample>(a: &[[A; 3]], b: &[[B; 3]], size: UVec2) -> [f64; 3] {
    let columns = size.x / CELL;
    let cells: Vec<Option<Cell>> = (0..size.y / CELL)
        .flat_map(|y| (0..columns).map(move |x| CELL * UVec2::new(x, y)))
        .map(|first| Cell::of(a, b, size.x, first))
        .collect();
    let beside = |i: usize| (i as u32 % columns + 1 < columns).then(|| Some((cells[i]?, cells[i + 1]?))).flatten();
    let pairs: Vec<(Cell, Cell)> = (0..cells.len()).filter_map(beside).collect();
    std::array::from_fn(|c| {
        let mut ratios: Vec<f64> = pairs.iter().filter_map(|(one, other)| one.ratio(other, c)).collect();
        if ratios.len() < LEAST_PAIRS {
            return 1.0;
        }
        ratios.sort_by(f64::total_cmp);
        let factor = ratios[ratios.len() / 2] / MEDIAN_SQUARE;
        if factor < LEAST_FACTOR { 1.0 } else { factor }
    })
}

/// A - B over the pixels of a cell: sums, and of the squares.
#[derive(Clone, Copy)]
struct Cell {
    sum: [f64; 3],
    squares: [f64; 3],
}

impl Cell {
    /// None where a pixel is bad.
    fn of<A: Sample, B: Sample>(a: &[[A; 3]], b: &[[B; 3]], width: u32, first: UVec2) -> Option<Self> {
        let mut cell = Self { sum: [0.0; 3], squares: [0.0; 3] };
        for y in first.y..first.y + CELL {
            for x in first.x..first.x + CELL {
                let at = y as usize * width as usize + x as usize;
                if !comparable(a[at], b[at]) {
                    return None;
                }
                let (a, b): ([f64; 3], [f64; 3]) = (a[at].map(Into::into), b[at].map(Into::into));
                for c in 0..3 {
                    cell.sum[c] += a[c] - b[c];
                    cell.squares[c] += (a[c] - b[c]).powi(2);
                }
            }
        }
        Some(cell)
    }

    /// The square of two means' difference, by what it would be on average if pixels were independent; none where all are equal.
    fn ratio(&self, other: &Self, c: usize) -> Option<f64> {
        let pixels = f64::from(CELL * CELL);
        let mean = (self.sum[c] + other.sum[c]) / (2.0 * pixels);
        let variance = (self.squares[c] + other.squares[c]) / (2.0 * pixels) - mean * mean;
        let difference = (self.sum[c] - other.sum[c]) / pixels;
        (variance > 1e-12 * mean * mean && variance > 0.0).then(|| difference * difference * pixels / (2.0 * variance))
    }
}
