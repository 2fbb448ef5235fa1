//! The robust means of a film.

use super::mean::{RobustMean, brightness, robust_mean};
use crate::layout::film::RobustPixel;
use crate::parallel;
use crate::stats::metrics::DARK;

/// Pixels that a thread takes at once.
const PIECE: usize = 1 << 12;

/// Pixels that are named.
const NAMED: usize = 4;

/// A film's robust means, and where they part from the plain ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobustFilm {
    /// Row by row from the top of the window, linear Rec.709; black without samples.
    pub rgb: Vec<[f32; 3]>,
    /// Whether each parts from the plain mean by more than the spread of its blocks explains.
    pub parts: Vec<bool>,
    /// Mean luminance over all pixels that have samples: of the plain means, and of the robust ones.
    pub plain: f64,
    pub robust: f64,
    /// The part of those pixels whose means part.
    pub parted: f64,
    /// Those that part most, relative to what they show, the worst first.
    pub worst: Vec<Worst>,
}

/// A pixel that hangs on few samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Its place in the window, row by row from the top.
    pub index: usize,
    /// Luminance of the plain mean, and of the robust one.
    pub plain: f64,
    pub robust: f64,
    /// Luminance of its brightest sample, and which film sample that is.
    pub brightest: f32,
    pub sample: u32,
}

/// Of the blocks of a film's pixels.
pub fn robust_film(blocks: &[RobustPixel], exponent: i32) -> RobustFilm {
    let piece = |number: usize| -> Vec<Option<RobustMean>> {
        let pixels = blocks.iter().skip(number * PIECE).take(PIECE);
        pixels.map(|pixel| robust_mean(pixel, exponent)).collect()
    };
    let means: Vec<Option<RobustMean>> =
        parallel::map(blocks.len().div_ceil(PIECE), piece).into_iter().flatten().collect();
    let there: Vec<&RobustMean> = means.iter().flatten().collect();
    let count = there.len().max(1) as f64;
    let over = |of: &dyn Fn(&RobustMean) -> f64| there.iter().map(|mean| of(mean)).sum::<f64>() / count;
    RobustFilm {
        rgb: means.iter().map(|mean| mean.unwrap_or_default().robust.map(|channel| channel as f32)).collect(),
        parts: means.iter().map(|mean| mean.is_some_and(|mean| mean.parts)).collect(),
        plain: over(&|mean| brightness(mean.plain)),
        robust: over(&|mean| brightness(mean.robust)),
        parted: over(&|mean| f64::from(u8::from(mean.parts))),
        worst: worst(blocks, &means),
    }
}

fn worst(blocks: &[RobustPixel], means: &[Option<RobustMean>]) -> Vec<Worst> {
    let named = |(index, (pixel, mean)): (usize, (&RobustPixel, &Option<RobustMean>))| {
        let mean = mean.filter(|mean| mean.parts)?;
        let (plain, robust) = (brightness(mean.plain), brightness(mean.robust));
        Some(Worst { index, plain, robust, brightest: pixel.brightest, sample: pixel.sample })
    };
    let mut all: Vec<Worst> = blocks.iter().zip(means).enumerate().filter_map(named).collect();
    let gap = |worst: &Worst| (worst.plain - worst.robust).powi(2) / (worst.robust * worst.robust + DARK);
    all.sort_by(|a, b| gap(b).total_cmp(&gap(a)).then(a.index.cmp(&b.index)));
    all.truncate(NAMED);
    all
}
