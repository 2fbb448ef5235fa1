//! The picture that both are held to: the mean of a long one of each, if those agree.

use serde::{Deserialize, Serialize};

use super::peer::Peer;
use crate::app::bench::BenchError;
use crate::app::bench::light::configuration::Configuration;
use crate::app::bench::light::record::ReferenceRecord;
use crate::app::bench::light::reference::{Reference, TRUSTED};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::components::Render;
use crate::stats::metrics::{DARK, relative_mse};
use crate::stats::summary::Summary;

/// How Lucerna makes its own.
pub const BY: Configuration = TRUSTED;

/// Calls that a half of the peer's is made of.
const PARTS: u32 = 4;

/// Seeds of the halves: of no picture that is measured.
const SEED: u32 = 0x4000_0000;

/// Part of the error that is measured by which two references may differ beyond their noise.
const TOLERATED: f64 = 0.1;

/// Two pictures of one scene by one program, with noise of their own: linear radiance, row by row from the top.
#[derive(Clone, Debug, Default)]
pub struct Halves {
    pub pictures: [Vec<[f32; 3]>; 2],
    /// Of rendering both.
    pub seconds: f64,
}

/// What two references are to each other, as relMSE.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// Of Lucerna's and of the peer's, by their own noise.
    pub noise: [f64; 2],
    /// What they differ by beyond noise, and its standard error: an estimate without bias, so it may be below 0.
    pub difference: f64,
    pub standard_error: f64,
    /// The mean of the peer's picture by Lucerna's, less 1.
    pub mean: f64,
    /// Whether they are one picture, but for a tenth of the error that is measured.
    pub agree: bool,
}

/// Traces Lucerna's, of `spp` samples a pixel in all. None if a signal came before its end.
pub fn of_lucerna(tracer: &mut Tracer, spp: u32, monitor: &mut Monitor) -> Result<Option<Halves>, BenchError> {
    let before = tracer.report()?.seconds_trace;
    let mut halves = Halves::default();
    for (picture, seed) in halves.pictures.iter_mut().zip(SEED..) {
        tracer.set(Render { seed, spp: spp.div_ceil(2), ..BY.of(&tracer.render) });
        if !tracer.finish(monitor)? {
            return Ok(None);
        }
        *picture = tracer.radiance()?;
    }
    halves.seconds = tracer.report()?.seconds_trace - before;
    Ok(Some(halves))
}

/// Renders the peer's.
pub fn of_peer(
    peer: &mut Peer,
    spp: u32,
    (monitor, pixels): (&mut Monitor, u64),
) -> Result<Option<Halves>, BenchError> {
    let part = spp.div_ceil(2 * PARTS);
    let mut halves = Halves::default();
    for (half, picture) in halves.pictures.iter_mut().enumerate() {
        let mut sum = vec![[0.0f64; 3]; pixels as usize];
        for index in 0..PARTS {
            let Some(rendered) = peer.render(part, SEED + half as u32 * PARTS + index)? else { return Ok(None) };
            for (sum, pixel) in sum.iter_mut().zip(rendered.rgb) {
                (0..3).for_each(|c| sum[c] += f64::from(pixel[c]));
            }
            halves.seconds += rendered.seconds;
            monitor.meter.advance(pixels * u64::from(part), part);
        }
        *picture = sum.into_iter().map(|pixel| pixel.map(|c| (c / f64::from(PARTS)) as f32)).collect();
    }
    Ok(Some(halves))
}

/// Holds two references against each other, where errors down to `to` are to be measured.
///
/// The differences of two pairs of halves have noise that has nothing in common, so the mean of their products is what the programs
/// themselves differ by.
pub fn agreement(ours: &Halves, theirs: &Halves, to: f64) -> Agreement {
    let ([a, b], [c, d]) = (&ours.pictures, &theirs.pictures);
    let (mut noise, mut sums, mut products) = ([0.0; 2], [0.0; 2], Vec::with_capacity(a.len()));
    for (((a, b), c), d) in a.iter().zip(b).zip(c).zip(d) {
        let mut product = 0.0;
        for channel in 0..3 {
            let [a, b, c, d] = [a, b, c, d].map(|pixel| f64::from(pixel[channel]));
            let whole = 0.25 * (a + b + c + d);
            let scale = 1.0 / (3.0 * (whole * whole + DARK));
            noise[0] += scale * (0.5 * (a - b)).powi(2);
            noise[1] += scale * (0.5 * (c - d)).powi(2);
            product += scale * (c - a) * (d - b);
            sums[0] += a + b;
            sums[1] += c + d;
        }
        products.push(product);
    }
    let found = Summary::of(&products);
    let difference = found.map_or(f64::INFINITY, |found| found.mean);
    Agreement {
        noise: noise.map(|sum| sum / products.len().max(1) as f64),
        difference,
        standard_error: found.and_then(|found| found.standard_error).unwrap_or(0.0),
        mean: sums[1] / sums[0].max(f64::MIN_POSITIVE) - 1.0,
        // What is no number agrees with nothing.
        agree: difference <= TOLERATED * to,
    }
}

/// One picture of both, each by what it is worth. `record` says what is not known by the pictures.
pub fn together(ours: &Halves, theirs: &Halves, agreement: &Agreement, record: ReferenceRecord) -> Reference {
    let [a, b] = agreement.noise.map(|noise| 1.0 / noise.max(1e-30));
    let part = b / (a + b);
    let mean = |halves: &Halves, pixel: usize, c: usize| {
        0.5 * (f64::from(halves.pictures[0][pixel][c]) + f64::from(halves.pictures[1][pixel][c]))
    };
    let mixed = |pixel: usize| {
        std::array::from_fn(|c| ((1.0 - part) * mean(ours, pixel, c) + part * mean(theirs, pixel, c)) as f32)
    };
    let rgb = (0..ours.pictures[0].len()).map(mixed).collect();
    let record = ReferenceRecord { relmse: 1.0 / (a + b), seconds: ours.seconds + theirs.seconds, ..record };
    Reference { rgb, record }
}

/// What a picture's error against a reference is, without that of the reference.
pub fn error(picture: &[[f32; 3]], reference: &Reference) -> f64 {
    relative_mse(picture, &reference.rgb) - reference.record.relmse
}
