//! How far a film's true relMSE may be from what it tells: by the product of the errors of its halves, e0 e1, whose mean is 0.
//!
//! Errors of a pixel in the two halves are of one variance, as nearly are those of the four pixels of a quad, and all of these are independent:
//! where paths are reused a quad has a pixel of each of its block's four tiles. So the products of what two pixels of a quad tell show how large
//! e0 e1 is, whatever the tails. Nothing follows from a pixel's own square: a rare bright sample is in it twice, but in e0 e1 once.
//! Pixels of a tile share errors. That shows in how the quads of a block go together, whichever pixels of them are of one tile.

use glam::UVec2;

use super::radiance::Share;

/// Pixels a side of a block, which no tile goes beyond: of the whole film.
pub const BLOCK: usize = 8;

/// Pixels of a quad.
const QUAD: usize = 4;

/// Those that there are of them.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// How much of the square of what a pixel might add counts as variance: that is what weights may be wrong by.
const DOUBT: f64 = 0.4;

/// Of some blocks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spread {
    /// Sum of variances over blocks.
    variance: f64,
    /// Sum of their squares.
    squares: f64,
}

impl Spread {
    /// Of some rows, the first of which has its first pixel at `first` in the whole film.
    pub fn of(shares: &[Share], width: usize, first: UVec2) -> Self {
        let height = shares.len() / width.max(1);
        let mut spread = Self::default();
        for rows in cells(first.y as usize, height, BLOCK) {
            for columns in cells(first.x as usize, width, BLOCK) {
                let (left, top) = (first.x as usize + columns.start, first.y as usize + rows.start);
                let quads =
                    cells(top, rows.len(), 2).flat_map(|y| cells(left, columns.len(), 2).map(move |x| (x, y.clone())));
                let at = |x: usize, y: usize| &shares[(rows.start + y) * width + columns.start + x];
                let mut block = Block::default();
                for (x, y) in quads {
                    block.add(y.flat_map(|y| x.clone().map(move |x| (x, y))).map(|(x, y)| at(x, y)));
                }
                let variance = block.variance();
                spread.variance += variance;
                spread.squares += variance * variance;
            }
        }
        spread
    }

    pub fn and(self, other: Self) -> Self {
        Self { variance: self.variance + other.variance, squares: self.squares + other.squares }
    }

    /// Standard deviation of the sum of relative errors, and how many blocks it is made of, as if all were alike.
    pub fn deviation(&self) -> (f64, f64) {
        let blocks = if self.squares > 0.0 { self.variance * self.variance / self.squares } else { 1.0 };
        (self.variance.sqrt(), blocks.max(1.0))
    }
}

/// Where a list of `count` places, of which the first has the number `first`, is cut if cells of `side` begin at 0.
fn cells(first: usize, count: usize, side: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
    let before = first % side;
    (0..(before + count).div_ceil(side))
        .map(move |cell| (cell * side).saturating_sub(before)..((cell + 1) * side - before).min(count))
}

/// Sums over a block.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    /// Pixels, and those of quads that are whole.
    pixels: f64,
    whole: f64,
    /// Over the pairs of pixels of each quad: the square of the product of what they tell.
    pairs: f64,
    /// Over quads: what their pixels have in common, and the square of it.
    common: f64,
    common_squares: f64,
    /// Over pixels: the square of what each might add.
    doubt: f64,
}

impl Block {
    /// Adds the pixels of a quad.
    fn add<'s>(&mut self, shares: impl Iterator<Item = &'s Share>) {
        let mut quad = [[0.0; 3]; QUAD];
        let mut count = 0;
        for share in shares.filter(|share| share.is_there) {
            quad[count] = share.errors;
            count += 1;
            self.doubt += share.most * share.most;
        }
        self.pixels += count as f64;
        if count < QUAD {
            return;
        }
        self.whole += QUAD as f64;
        let mut common = 0.0;
        for (a, b) in PAIRS {
            let product: f64 = (0..3).map(|c| quad[a][c] * quad[b][c]).sum();
            self.pairs += product * product;
            common += 2.0 * product;
        }
        self.common += common;
        self.common_squares += common * common;
    }

    /// Of the block's sum of relative errors. Twice what a pixel tells is an error of a half, so products of two such are four times
    /// those of what is told. A quad has 6 pairs and 4 pixels. Two quads have 24 ways to take two pixels of one and two of the other, in order and
    /// so that the two tiles of the one are those of the other, for 4 pairs of one tile each.
    fn variance(&self) -> f64 {
        let own = 4.0 * 4.0 / 6.0 * self.pairs;
        let tiles = 4.0 * 4.0 / 24.0 * (self.common * self.common - self.common_squares);
        let missing = if self.whole > 0.0 { self.pixels / self.whole } else { 0.0 };
        missing * (own + tiles).max(0.0) + DOUBT * self.doubt
    }
}
