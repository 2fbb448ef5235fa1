//! Many equal samples, added however they are cut.

use glam::Vec3;

use crate::cpu::film::pixel_mean;
use crate::layout::film::film_exponent;
use crate::layout::trace::{RadianceSample, TraceParams};
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::sums::{add, read, reset};

pub static ROW: Row = Row {
    name: "film-sums",
    holds: "a million samples of 0.1, of 0.3 and of 0.7 have these means, and the same bits however batches cut them",
    quantity: "relative error of a mean",
    most: 1e-6,
    unit: "samples",
    sizes: [6_000_000, 6_000_000, 300_000_000],
    measure,
};

/// Samples of a batch.
const CUTS: [u32; 2] = [16_384, 9_973];
const VALUES: [f32; 3] = [0.1, 0.3, 0.7];

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let count = (size / (CUTS.len() * VALUES.len()) as u64) as u32;
    let params = TraceParams { film_width: 3, window_width: 3, window_height: 1, ..TraceParams::default() };
    let exponent = film_exponent(0.7);
    let mut rig = lab.rig();
    let mut films = Vec::new();
    let mut all = Measured::new(0.0, 0);
    for (k, cut) in CUTS.into_iter().enumerate() {
        reset(&mut rig, &params)?;
        let mut first = 0;
        while first < count {
            let layers = cut.min(count - first);
            let grey = |i: u32| RadianceSample { rgb: Vec3::splat(VALUES[i as usize % 3]), info: 1 };
            let part: Vec<_> = (0..layers * 3).map(grey).collect();
            add(&mut rig, &params, first, &part, exponent)?;
            first += layers;
            lab.tell(u64::from(first) + k as u64 * u64::from(count), 2 * u64::from(count));
        }
        let (film, _) = read(&rig, &params)?;
        for (pixel, value) in film.iter().zip(VALUES) {
            let (mean, samples) = pixel_mean(pixel, exponent);
            if samples != count {
                return Err(StressError::Broken(format!("{samples} samples of {count} were added")));
            }
            let off = greatest(mean.iter().map(|m| (m / f64::from(value) - 1.0).abs()));
            all = all.worst(Measured::new(off, u64::from(count)).noted(format!("samples of {value}")));
        }
        films.push(film);
    }
    if films[0] != films[1] {
        return Err(StressError::Broken("another cut gives another film".to_owned()));
    }
    Ok(all)
}
