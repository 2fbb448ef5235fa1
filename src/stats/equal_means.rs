//! Whether two estimators have one mean: by pairs of films, block by block and over the whole picture.
//!
//! **The test.** Differences of a block over pairs of films are tested by flipping their signs ([`sign_flips`]), which needs
//! no variance and no normal tails. If the estimators are equal, differences are symmetric, and the level holds exactly,
//! fireflies or not. If one only has less noise, or other tails, differences need not be symmetric; pairs are summed in
//! groups, whose sums become so as there are more of them. Light that one of them finds seldom, and has not found yet, looks like
//! a difference, and no test can tell it from one (Bahadur, Savage 1956); so there must be some films, and a block that is much
//! quieter than those around it or than the picture is held to their noise (`tests/judge/simulated.rs` says how far that
//! helps). Trimming or a rank test would compare medians,
//! and an estimator is right by its mean.
//!
//! **The level.** Alpha is what may go wrong over all looks, blocks and the whole picture together. Of looks at growing
//! numbers of films the first spends half of it, the next a quarter, and so on (Lan, DeMets 1983 allow any such split); half
//! of a look's share goes to the whole picture, half to all blocks by Holm's step-down (1979). Red, green and blue are tested by
//! themselves, so that colours which change places are no equal means; the one that shows most speaks for a block, at three times its p.
//!
//! **The power.** What a look could not have missed is told beside what it saw: the least difference of the whole picture that it would
//! have found ([`least_found`]). Without that, "no difference" says nothing.
//!
//! [`sign_flips`]: super::sign_flips

use glam::UVec2;

use super::blocks::{BLACK, Grid, ROUNDING};
use super::sign_flips::{least_found, tail_bound};
use super::summary::variance;

/// Groups of pairs, at most: then neighbours are joined.
const MOST_GROUPS: usize = 128;

/// Channels of a pixel.
const CHANNELS: usize = 3;

/// Groups below which nothing is said, and looks cost nothing. With 32 the smallest p there can be is 2^(1 - 32) = 5e-10.
pub const LEAST_GROUPS: usize = 32;

/// A block's noise by its mean is taken to be at least this part of the picture's: of squares, so half of its noise.
const LEAST_SQUARES: f64 = 0.25;

/// Side of blocks, pixels, in a picture of this size: 16, or where it is small, an eighth of its shorter side.
pub fn block_side(size: UVec2) -> u32 {
    (size.min_element() / 8).clamp(4, 16)
}

/// What is known of a block, or of the whole picture: of the channel that shows most of a difference. Radiance is the mean over pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// First pixel.
    pub min: UVec2,
    /// The pixel behind the last.
    pub max: UVec2,
    /// 0 to 2: red, green, blue.
    pub channel: usize,
    /// Another channel differs by less than half as much, or the other way: it is one of colour.
    pub coloured: bool,
    /// Mean of the old estimator.
    pub old: f64,
    /// Mean of the new one less that.
    pub difference: f64,
    /// Of the difference; none from fewer than two pairs.
    pub standard_error: Option<f64>,
    /// The difference by the old mean; by a thousandth of the picture's, if that is more.
    pub relative: f64,
    /// Upper bound of the probability of such a difference by chance in any channel, before many blocks are allowed for.
    pub p: f64,
    /// More than chance explains, all tests allowed for.
    pub differs: bool,
}

/// What one look saw.
#[derive(Clone, Debug, PartialEq)]
pub struct Means {
    pub whole: Difference,
    /// Row by row.
    pub blocks: Vec<Difference>,
    /// Part of alpha that this look spent.
    pub spent: f64,
    /// The least difference of the whole picture, by its mean, that would have been found in 19 of 20 such runs; none where nothing
    /// would, and of a picture that is black.
    pub least_found: Option<f64>,
    /// No film had any light.
    pub black: bool,
}

impl Means {
    /// Whether the two have different means.
    pub fn differ(&self) -> bool {
        self.whole.differs || self.differing().next().is_some()
    }

    /// The blocks whose means differ.
    pub fn differing(&self) -> impl Iterator<Item = &Difference> {
        self.blocks.iter().filter(|block| block.differs)
    }
}

/// Takes in pairs of films, and looks at them now and then.
#[derive(Clone, Debug)]
pub struct MeansTest {
    grid: Grid,
    /// Pixels of each block.
    pixels: Vec<f64>,
    /// What is left for looks to come.
    alpha: f64,
    /// By group: new less old of each block and last of the whole picture, channel by channel, summed over the group's pairs.
    groups: Vec<Vec<f64>>,
    /// Pairs of a whole group.
    group_size: u32,
    /// The group that is not whole yet, and its pairs.
    open: (Vec<f64>, u32),
    /// Of the old estimator, as in `groups`, and of both less each other: over all pairs.
    old: Vec<f64>,
    difference: Vec<f64>,
    pairs: u32,
}

impl MeansTest {
    /// For pictures cut like this; `alpha` is the probability of any false alarm, over all looks.
    pub fn new(grid: Grid, alpha: f64) -> Self {
        let pixels = |index| {
            let (min, max) = bounds(&grid, index);
            f64::from((max.x - min.x) * (max.y - min.y))
        };
        let blocks = (grid.count.x * grid.count.y) as usize;
        let zeros = vec![0.0; CHANNELS * (blocks + 1)];
        Self {
            grid,
            pixels: (0..blocks).map(pixels).collect(),
            alpha,
            groups: Vec::new(),
            group_size: 1,
            open: (zeros.clone(), 0),
            old: zeros.clone(),
            difference: zeros,
            pairs: 0,
        }
    }

    /// What is left of alpha: another test may have it, if this one looks no more.
    pub fn alpha_left(&self) -> f64 {
        self.alpha
    }

    /// Whether there are pairs enough for a look to say anything.
    pub fn tells(&self) -> bool {
        self.groups.len() >= LEAST_GROUPS
    }

    /// Takes in a film of each, of the grid's size, row by row.
    pub fn add(&mut self, old: &[[f32; 3]], new: &[[f32; 3]]) {
        let means = [old, new].map(|film| block_means(film, &self.grid));
        self.add_means(&means[0], &means[1]);
    }

    /// Takes in a pair by the means of its blocks.
    pub fn add_means(&mut self, old: &[[f64; 3]], new: &[[f64; 3]]) {
        if self.groups.len() == MOST_GROUPS && self.open.1 + 1 == self.group_size {
            self.join_groups();
        }
        let total: f64 = self.pixels.iter().sum();
        for channel in 0..CHANNELS {
            let mut whole = [0.0; 2];
            for (block, (old, new)) in old.iter().zip(new).enumerate() {
                let (share, old, more) = (self.pixels[block] / total, old[channel], new[channel] - old[channel]);
                whole = [whole[0] + share * old, whole[1] + share * more];
                self.take(CHANNELS * block + channel, old, more);
            }
            self.take(CHANNELS * self.pixels.len() + channel, whole[0], whole[1]);
        }
        self.pairs += 1;
        self.open.1 += 1;
        if self.open.1 == self.group_size {
            let empty = vec![0.0; self.open.0.len()];
            self.groups.push(std::mem::replace(&mut self.open.0, empty));
            self.open.1 = 0;
        }
    }

    fn take(&mut self, place: usize, old: f64, difference: f64) {
        self.open.0[place] += difference;
        self.old[place] += old;
        self.difference[place] += difference;
    }

    /// Joins every two groups. The open one stays open, with room for as many again.
    fn join_groups(&mut self) {
        let sum = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| a + b).collect();
        self.groups = self.groups.chunks_exact(2).map(sum).collect();
        self.group_size *= 2;
    }

    /// Looks at all whole groups, and spends half of the alpha that is left; of fewer than [`LEAST_GROUPS`] nothing is said.
    pub fn look(&mut self) -> Means {
        let spent = if self.tells() { 0.5 * self.alpha } else { 0.0 };
        self.alpha -= spent;
        let (squares, blocks) = (self.cautious_squares(), self.pixels.len());
        let light = self.old[CHANNELS * blocks..].iter().sum::<f64>() / f64::from(self.pairs.max(1));
        let dark = BLACK * light / CHANNELS as f64;
        let mut blocks: Vec<Difference> = (0..blocks).map(|block| self.difference_at(block, &squares, dark)).collect();
        let mut whole = self.difference_at(blocks.len(), &squares, dark);
        whole.differs = whole.p < 0.5 * spent;
        hold(&mut blocks, 0.5 * spent);
        let least_found = self.least_found(0.5 * spent);
        Means { whole, blocks, spent, least_found, black: light == 0.0 && whole.difference == 0.0 }
    }

    /// Sum of squares over the groups: their noise, with any difference there is in it.
    fn squares(&self, place: usize) -> f64 {
        self.groups.iter().map(|group| group[place] * group[place]).sum()
    }

    /// The squares of every block's channels, and at least their mean over it and those around it, and a part of what the picture's
    /// relative ones let expect; of the whole picture, none. Flipping signs changes none of that: it exchanges films, and leaves
    /// squares and means of both.
    fn cautious_squares(&self) -> Vec<f64> {
        let places = CHANNELS * self.pixels.len();
        let own: Vec<f64> = (0..places).map(|place| self.squares(place)).collect();
        let brightness: Vec<f64> =
            self.old.iter().zip(&self.difference).map(|(old, more)| (old + 0.5 * more).powi(2)).collect();
        let lit = || own.iter().zip(&brightness).filter(|(_, brightness)| **brightness > 0.0);
        let relative = lit().map(|(own, brightness)| own / brightness).sum::<f64>() / lit().count().max(1) as f64;
        let cautious = |place: usize| {
            let near = || self.around(place / CHANNELS).map(|block| own[CHANNELS * block + place % CHANNELS]);
            let around = near().sum::<f64>() / near().count() as f64;
            own[place].max(around).max(LEAST_SQUARES * relative * brightness[place])
        };
        (0..places).map(cautious).chain([0.0; CHANNELS]).collect()
    }

    /// A block and those that touch it.
    fn around(&self, block: usize) -> impl Iterator<Item = usize> {
        let count = self.grid.count;
        let (x, y) = (block as u32 % count.x, block as u32 / count.x);
        let columns = x.saturating_sub(1)..(x + 2).min(count.x);
        let rows = y.saturating_sub(1)..(y + 2).min(count.y);
        rows.flat_map(move |y| columns.clone().map(move |x| (y * count.x + x) as usize))
    }

    /// A block, or the whole picture, without what depends on others: its channel of the least p. Means below `dark` count as that.
    fn difference_at(&self, block: usize, squares: &[f64], dark: f64) -> Difference {
        let whole = block == self.pixels.len();
        let (min, max) = if whole { (UVec2::ZERO, self.grid.size) } else { bounds(&self.grid, block) };
        let channels: [Difference; CHANNELS] = std::array::from_fn(|channel| {
            let place = CHANNELS * block + channel;
            let pairs = f64::from(self.pairs.max(1));
            let (old, difference) = (self.old[place] / pairs, self.difference[place] / pairs);
            let relative = if difference == 0.0 { 0.0 } else { difference / old.max(dark) };
            let (standard_error, p) = self.chance(place, squares[place]);
            Difference {
                min,
                max,
                channel,
                coloured: false,
                old,
                difference,
                standard_error,
                relative,
                p,
                differs: false,
            }
        });
        let most =
            channels.into_iter().reduce(|a, b| if b.p < a.p { b } else { a }).expect("invariant: three channels");
        let lags = |other: &Difference| other.old > 0.0 && other.relative / most.relative < 0.5;
        Difference { coloured: channels.iter().any(lags), p: (CHANNELS as f64 * most.p).min(1.0), ..most }
    }

    /// Standard error of a place's difference, and the bound of its probability. The sum of its squares is taken to be at least
    /// `squares`.
    fn chance(&self, place: usize, squares: f64) -> (Option<f64>, f64) {
        let sizes: Vec<f64> = self.groups.iter().map(|group| group[place]).collect();
        let grouped = f64::from(self.group_size) * sizes.len() as f64;
        let error = variance(&sizes).map(|variance| (variance * sizes.len() as f64).sqrt() / grouped);
        let own = self.squares(place);
        let caution = if own < squares { (own / squares).sqrt() } else { 1.0 };
        let old = self.old[place] / f64::from(self.pairs.max(1));
        let beyond = (sizes.iter().sum::<f64>().abs() - ROUNDING * old * grouped).max(0.0) * caution;
        (error, if beyond > 0.0 { tail_bound(&sizes, beyond) } else { 1.0 })
    }

    /// By the whole picture's channel in which a grey difference shows best, at this level.
    fn least_found(&self, level: f64) -> Option<f64> {
        let first = CHANNELS * self.pixels.len();
        let lit = (first..first + CHANNELS).filter(|place| self.old[*place] > 0.0 && level > 0.0);
        let least = |place: usize| {
            let sizes: Vec<f64> = self.groups.iter().map(|group| group[place]).collect();
            let shift = least_found(&sizes, level / CHANNELS as f64)?;
            let mean = self.old[place] / f64::from(self.pairs);
            Some(shift / (f64::from(self.group_size) * mean) + ROUNDING)
        };
        lit.filter_map(least).reduce(f64::min)
    }
}

/// Holm's step-down: the smallest p is held to level / n, the next to level / (n - 1), until one is not below.
fn hold(blocks: &mut [Difference], level: f64) {
    let mut order: Vec<usize> = (0..blocks.len()).collect();
    order.sort_by(|a, b| blocks[*a].p.total_cmp(&blocks[*b].p));
    for (rank, index) in order.iter().enumerate() {
        if blocks[*index].p >= level / (blocks.len() - rank) as f64 {
            break;
        }
        blocks[*index].differs = true;
    }
}

fn bounds(grid: &Grid, index: usize) -> (UVec2, UVec2) {
    let index = index as u32;
    grid.bounds(UVec2::new(index % grid.count.x, index / grid.count.x))
}

/// Mean over the pixels of every block.
fn block_means(film: &[[f32; 3]], grid: &Grid) -> Vec<[f64; 3]> {
    let mean = |index| {
        let (min, max) = bounds(grid, index);
        let rows = (min.y..max.y).map(|y| {
            let row = (y * grid.size.x) as usize;
            &film[row + min.x as usize..row + max.x as usize]
        });
        let add = |sum: [f64; 3], pixel: &[f32; 3]| std::array::from_fn(|c| sum[c] + f64::from(pixel[c]));
        let sum = rows.flatten().fold([0.0; CHANNELS], add);
        let pixels = f64::from((max.x - min.x) * (max.y - min.y)).max(1.0);
        sum.map(|channel| channel / pixels)
    };
    (0..(grid.count.x * grid.count.y) as usize).map(mean).collect()
}
