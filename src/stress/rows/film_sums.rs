//! Many equal samples, added however they are cut.

use glam::Vec3;

use crate::cpu::film::{accumulate, pixel_mean};
use crate::layout::film::{FilmPixel, MOST_SAMPLES, film_exponent, largest_sample};
use crate::layout::trace::{RadianceSample, TraceParams};
use crate::passes::film::accumulate_params;
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::sums::{add, read, reset};

pub static ROW: Row = Row {
    name: "film-sums",
    holds: "a million samples of 0.1, 0.3 and 0.7 have these means, the same bits however cut; a film that is full keeps its mean",
    quantity: "relative error of a mean",
    most: 1e-6,
    unit: "samples",
    sizes: [6_000_000, 6_000_000, (CUTS.len() * VALUES.len()) as u64 * MOST_SAMPLES as u64],
    measure,
};

/// Samples of a batch: four rounds of loops each, of which edited shaders have 65,535.
const CUTS: [u32; 2] = [12_288, 9_973];
const VALUES: [f32; 3] = [0.1, 0.3, 0.7];

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    fill(lab)?;
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
        let (film, counters) = read(&rig, &params)?;
        if counters.bad.0 > 0 || counters.full.0 > 0 {
            let (bad, full) = (counters.bad.0, counters.full.0);
            return Err(StressError::Broken(format!("{bad} samples were refused, {full} halves are full")));
        }
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

/// A film that is full: samples as bright as may be, and black ones, by turns. It is the twin's, and its mean that of the samples that it took.
fn fill(lab: &Lab) -> Result<(), StressError> {
    let exponent = film_exponent(1.0);
    let bright = largest_sample(exponent).next_down();
    let sample = |i: u32| RadianceSample { rgb: Vec3::splat(if i & 2 == 0 { bright } else { 0.0 }), info: 1 };
    let samples: Vec<_> = (0..2000).map(sample).collect();
    let params =
        TraceParams { film_width: 1, window_width: 1, window_height: 1, layers: 2000, ..TraceParams::default() };
    let mut rig = lab.rig();
    reset(&mut rig, &params)?;
    add(&mut rig, &params, 0, &samples, exponent)?;
    let (film, counters) = read(&rig, &params)?;
    if counters.full.0 != 2 {
        return Err(StressError::Broken(format!("{} halves of 2 are full", counters.full.0)));
    }
    let mut twin = vec![FilmPixel::default()];
    accumulate(&mut twin, &samples, &accumulate_params(&params, exponent, &params));
    let (mean, count) = pixel_mean(&film[0], exponent);
    let off = (mean[0] / f64::from(bright) - 0.5).abs();
    match film == twin && off <= 1.0 / f64::from(count) {
        true => Ok(()),
        false => Err(StressError::Broken(format!("a film that is full is off by {off:.3} of its brightest samples"))),
    }
}
