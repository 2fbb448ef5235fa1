//! The display pass: the film's mean, exposed, as 8-bit sRGB. The twin of `passes/display/display`.

use glam::UVec2;

use super::tone::toned;
use crate::image::srgb::srgb_encode;
use crate::layout::film::{DisplayParams, FilmHalf, FilmPixel};

/// A picture word a pixel: r in the lowest byte, a = 255 in the highest.
pub fn display(film: &[FilmPixel], params: &DisplayParams) -> Vec<u32> {
    let shift = UVec2::new(params.column_shift, params.row_shift);
    let shown = |pixel: u32| {
        let corner = (UVec2::new(pixel % params.row, pixel / params.row) >> shift) << shift;
        &film[(corner.y * params.row + corner.x) as usize]
    };
    (0..params.pixels).map(|pixel| word(shown(pixel), params)).collect()
}

fn word(pixel: &FilmPixel, params: &DisplayParams) -> u32 {
    let [even, odd] = &pixel.halves;
    let linear = match params.by_halves != 0 && even.count > 0 && odd.count > 0 {
        true => {
            let [even, odd] = [even, odd].map(|half| linear(&[half], params.scale));
            [0, 1, 2].map(|c| 0.5 * (even[c] + odd[c]))
        }
        false => linear(&[even, odd], params.scale),
    };
    let codes = codes(linear, params.tone);
    (0..3).fold(0xff00_0000, |word, c| word | ((codes[c] + 0.5).floor() as u32) << (8 * c))
}

/// The mean of some halves of a pixel, exposed; black without samples.
fn linear(halves: &[&FilmHalf], scale: f32) -> [f64; 3] {
    let count: u32 = halves.iter().map(|half| half.count).sum();
    [0, 1, 2].map(|c| {
        let sums = halves.iter().map(|half| f64::from(half.sum[c].y) * 2f64.powi(32) + f64::from(half.sum[c].x));
        sums.sum::<f64>() / f64::from(count.max(1)) * f64::from(scale)
    })
}

/// Linear light as the display pass shows it, 2^`exposure` times as bright; opaque.
pub fn shown(linear: [f32; 3], exposure: f32, tone: u32) -> [u8; 4] {
    let scale = f64::from(exposure).exp2();
    let [r, g, b] =
        codes(linear.map(|channel| f64::from(channel) * scale), tone).map(|code| (code + 0.5).floor() as u8);
    [r, g, b, 255]
}

/// Exposed light by a `TONE_` curve as codes of 8 bits, not rounded.
fn codes(linear: [f64; 3], tone: u32) -> [f64; 3] {
    toned(linear, tone).map(|value| 255.0 * srgb_encode(value.clamp(0.0, 1.0)))
}

/// Pixels that are looked at for the error of a picture: its mean over more would be no other.
const MOST_LOOKED_AT: usize = 1 << 16;

/// The error that a picture is estimated to have, root mean square over pixels and channels, in codes of 8 bits: the halves are
/// independent, so half their difference is as large as the error of their mean. Infinite where no pixel has samples in both halves.
pub fn error(film: &[FilmPixel], params: &DisplayParams) -> f64 {
    let (mut sum, mut terms) = (0.0, 0u32);
    // An odd step goes through all columns of pictures whose width is a power of two.
    let step = film.len().div_ceil(MOST_LOOKED_AT) | 1;
    for pixel in film.iter().step_by(step).filter(|pixel| pixel.halves.iter().all(|half| half.count > 0)) {
        let [even, odd] = pixel.halves.each_ref().map(|half| codes(linear(&[half], params.scale), params.tone));
        sum += (0..3).map(|c| (0.5 * (even[c] - odd[c])).powi(2)).sum::<f64>();
        terms += 3;
    }
    if terms == 0 { f64::INFINITY } else { (sum / f64::from(terms)).sqrt() }
}
