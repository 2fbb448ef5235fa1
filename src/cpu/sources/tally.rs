//! Sums over pixels of what each way has of the error.

use std::collections::BTreeMap;

use glam::{DVec3, UVec2};

use super::class::{Class, Emitters, Way};
use crate::layout::sources::Contribution;
use crate::layout::trace::{RadianceSample, SAMPLE_BAD, TraceParams};
use crate::parallel;
use crate::stats::metrics::DARK;

/// Groups of pixels whose sums are kept apart: how they differ tells how sure the shares are.
pub const GROUPS: usize = 16;

/// Pixels of a side of the blocks that are dealt to groups: those that may share paths are of one group.
const BLOCK: u32 = 8;

/// Samples of all pixels of a window, with what their rays brought: layer by layer, pixel by pixel.
pub struct Batch<'a> {
    pub params: &'a TraceParams,
    pub samples: &'a [RadianceSample],
    /// Contributions of each path, those included that were not kept.
    pub counts: &'a [u32],
    /// The first of each path, the second of each, and so on.
    pub brought: &'a [Contribution],
    /// Paths are reused: samples have more than their own rays brought.
    pub reuses: bool,
}

/// Where a window's pixels are in a film, and the film's mean radiance: by it the error is relative.
#[derive(Clone, Copy)]
pub struct Means<'a> {
    /// The first pixel, in the whole film.
    pub min: UVec2,
    pub size: UVec2,
    /// Row by row from the top.
    pub means: &'a [[f32; 3]],
}

/// A pixel's own part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelShare {
    /// Squared relative error, all channels together.
    pub error: f64,
    /// The bounce that has most of it, and how much of all that bounces have without regard to signs.
    pub bounce: u32,
    pub bounce_share: f64,
    /// The same of ways.
    pub way: Option<Way>,
    pub way_share: f64,
}

/// What was summed up so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Of each group of pixels: sums of squared relative errors.
    pub classes: BTreeMap<Class, [f64; GROUPS]>,
    /// Pixels that had samples in both halves.
    pub pixels: u64,
    /// Contributions that were not kept.
    pub dropped: u64,
}

impl Tally {
    /// Adds the pixels of a batch, with the share of each: row by row of the part of its window that the film has.
    pub fn add(&mut self, batch: &Batch, film: Means, emitters: &Emitters) -> Vec<(UVec2, PixelShare)> {
        let rows = parallel::map(batch.params.window_height as usize, |y| {
            let mut tally = Tally::default();
            let shares = tally.add_row(batch, y as u32, film, emitters);
            (tally, shares)
        });
        let mut all = Vec::new();
        for (tally, shares) in rows {
            self.join(tally);
            all.extend(shares);
        }
        all
    }

    fn join(&mut self, other: Tally) {
        for (class, sums) in other.classes {
            let own = self.classes.entry(class).or_default();
            own.iter_mut().zip(sums).for_each(|(own, sum)| *own += sum);
        }
        self.pixels += other.pixels;
        self.dropped += other.dropped;
    }

    fn add_row(&mut self, batch: &Batch, y: u32, film: Means, emitters: &Emitters) -> Vec<(UVec2, PixelShare)> {
        let mut shares = Vec::new();
        for x in 0..batch.params.window_width {
            let at = UVec2::new(x, y) + UVec2::new(batch.params.window_x, batch.params.window_y);
            if at.cmplt(film.min).any() || (at - film.min).cmpge(film.size).any() {
                continue;
            }
            let place = at - film.min;
            let mean = film.means[(place.y * film.size.x + place.x) as usize].map(f64::from);
            let pixel = Pixel::of(batch, UVec2::new(x, y), emitters);
            self.dropped += pixel.dropped;
            let Some(terms) = pixel.terms(mean) else { continue };
            self.pixels += 1;
            let block = at / BLOCK % 4;
            let group = (4 * block.y + block.x) as usize;
            terms.iter().for_each(|(class, term)| self.classes.entry(*class).or_default()[group] += term);
            shares.push((place, PixelShare::of(&terms)));
        }
        shares
    }

    /// The relative error of an estimate from all samples of the batches, as a mean over pixels and channels.
    pub fn relmse(&self) -> f64 {
        let sum: f64 = self.classes.values().flatten().sum();
        sum / (3.0 * self.pixels.max(1) as f64)
    }
}

/// What the samples of a pixel brought.
struct Pixel {
    /// Good samples of each half.
    counts: [u32; 2],
    /// Of each half, by class.
    sums: BTreeMap<Class, [DVec3; 2]>,
    dropped: u64,
}

impl Pixel {
    fn of(batch: &Batch, at: UVec2, emitters: &Emitters) -> Self {
        let TraceParams { window_width, window_height, layers, first_sample, .. } = *batch.params;
        let stride = (window_width * window_height * layers) as usize;
        let kept = batch.brought.len() / stride.max(1);
        let mut pixel = Self { counts: [0; 2], sums: BTreeMap::new(), dropped: 0 };
        for layer in 0..layers {
            let place = ((layer * window_height + at.y) * window_width + at.x) as usize;
            let sample = &batch.samples[place];
            if sample.info & SAMPLE_BAD != 0 {
                continue;
            }
            let half = ((first_sample + layer) & 1) as usize;
            pixel.counts[half] += 1;
            let count = batch.counts[place] as usize;
            pixel.dropped += count.saturating_sub(kept) as u64;
            let mut own = DVec3::ZERO;
            for slot in 0..count.min(kept) {
                let one = &batch.brought[slot * stride + place];
                own += one.rgb.as_dvec3();
                pixel.add(Class::of(one, emitters), half, one.rgb.as_dvec3());
            }
            if batch.reuses {
                pixel.add(Class::GATHERED, half, sample.rgb.as_dvec3() - own);
            }
        }
        pixel
    }

    fn add(&mut self, class: Class, half: usize, rgb: DVec3) {
        self.sums.entry(class).or_default()[half] += rgb;
    }

    /// What each class has of the squared relative error of the mean over both halves; none where a half is empty.
    fn terms(&self, mean: [f64; 3]) -> Option<Vec<(Class, f64)>> {
        let [n0, n1] = self.counts.map(f64::from);
        if n0 == 0.0 || n1 == 0.0 {
            return None;
        }
        let differences: Vec<(Class, DVec3)> =
            self.sums.iter().map(|(class, [a, b])| (*class, *a / n0 - *b / n1)).collect();
        let whole: DVec3 = differences.iter().map(|(_, difference)| *difference).sum();
        // The square of the difference times this is the variance of the mean of both: a quarter for halves of as many samples.
        let share = n0 * n1 / ((n0 + n1) * (n0 + n1));
        let weights = DVec3::from(mean.map(|mean| share / (mean * mean + DARK)));
        Some(differences.into_iter().map(|(class, difference)| (class, (weights * difference).dot(whole))).collect())
    }
}

impl PixelShare {
    fn of(terms: &[(Class, f64)]) -> Self {
        let (bounce, bounce_share) = most(terms, |class| class.bounce).unwrap_or_default();
        let (way, way_share) = most(terms, |class| class.way).map_or((None, 0.0), |(way, share)| (Some(way), share));
        Self { error: terms.iter().map(|(_, term)| term).sum(), bounce, bounce_share, way, way_share }
    }
}

/// Which has most of the error, and its part of all that they have without regard to signs; none where there is no error.
fn most<K: Ord + Copy>(terms: &[(Class, f64)], key: impl Fn(&Class) -> K) -> Option<(K, f64)> {
    let mut sums: BTreeMap<K, f64> = BTreeMap::new();
    terms.iter().for_each(|(class, term)| *sums.entry(key(class)).or_default() += term);
    let all: f64 = sums.values().map(|sum| sum.abs()).sum();
    let greatest = sums.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (all > 0.0).then(|| (greatest.0, greatest.1.abs() / all))
}
