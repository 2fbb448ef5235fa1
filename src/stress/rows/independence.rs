//! Random numbers of pixels, halves, seeds and dimensions beside each other.

use glam::DVec4;

use crate::cpu::rng::Source;
use crate::layout::trace::SampleKey;
use crate::parallel;
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;

pub static ROW: Row = Row {
    name: "independence",
    holds: "numbers of neighbouring pixels, of halves, seeds, groups and bounces don't correlate, by Pcg and by Sobol",
    quantity: "correlation",
    most: 1e-3,
    unit: "pairs",
    // The correlation of n pairs has a deviation of n^-1/2: of 2^24, 2.4e-4.
    sizes: [10 << 24, 10 << 24, 10 << 26],
    measure,
};

/// What another number is beside.
type Beside = (&'static str, fn(SampleKey) -> (SampleKey, u32));

const BESIDE: [Beside; 5] = [
    ("pixels", |key| (SampleKey { pixel: key.pixel.wrapping_add(1), ..key }, 0)),
    ("halves", |key| (SampleKey { half: 1, ..key }, 0)),
    ("seeds", |key| (SampleKey { seed: 8, ..key }, 0)),
    ("groups", |key| (key, 4)),
    ("bounces", |key| (key, 8)),
];

/// Pairs that a thread takes at once.
const PIECE: u64 = 1 << 16;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let count = size / 10;
    let half = DVec4::splat(0.5);
    let mut all = Measured::new(0.0, 0);
    for (k, source) in [Source::Pcg, Source::Sobol].into_iter().enumerate() {
        for (j, (what, other)) in BESIDE.into_iter().enumerate() {
            let pair = |i: u64| {
                // One sample a pixel: those of one pixel depend on each other. Half of them the first, which shows the scrambles as
                // they are.
                let index = (i as u32 & 1) * ((i as u32).wrapping_mul(0x9e37_79b9) >> 28);
                let key = SampleKey { pixel: i as u32, index, half: 0, seed: 7 };
                let (beside, dimension) = other(key);
                (source.sample_4d(key, 0) - half) * (source.sample_4d(beside, dimension) - half)
            };
            let pieces = count.div_ceil(PIECE);
            let sums = parallel::map(pieces as usize, |piece| {
                (piece as u64 * PIECE..((piece as u64 + 1) * PIECE).min(count)).map(pair).sum::<DVec4>()
            });
            let off = greatest((sums.into_iter().sum::<DVec4>() * 12.0 / count as f64).abs().to_array());
            all = all.worst(Measured::new(off, count).noted(format!("{source:?}, {what}")));
            lab.tell((5 * k + j + 1) as u64, 10);
        }
    }
    Ok(all)
}
