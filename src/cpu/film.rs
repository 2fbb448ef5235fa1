//! The film on the CPU: the twin of the accumulate pass, the film's means, and its error from the two halves.

use glam::UVec2;

use crate::layout::film::{AccumulateParams, BadSample, FilmHalf, FilmPixel, SAMPLE_BITS, UNKNOWN_BOUNCE};
use crate::layout::trace::{
    BAD_INFINITE, BAD_NAN, BAD_NEGATIVE, BAD_OVERFLOW, NO_MATERIAL, RadianceSample, SAMPLE_BAD,
};
use crate::stats::metrics::DARK;

/// What a batch counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counted {
    pub rays: u64,
    /// Every bad sample, by layer and pixel.
    pub bad: Vec<BadSample>,
}

/// Adds a batch of samples to the film.
pub fn accumulate(film: &mut [FilmPixel], radiance: &[RadianceSample], params: &AccumulateParams) -> Counted {
    let mut counted = Counted::default();
    let pixels = params.window_width * params.window_height;
    let index = |place: UVec2| (params.first_pixel + place.y * params.row + place.x) as usize;
    if params.replaces != 0 {
        (0..pixels).for_each(|pixel| film[index(place_of(pixel, params))] = FilmPixel::default());
    }
    for layer in 0..params.layers {
        let sample = params.first_sample + layer;
        for pixel in 0..pixels {
            let (x, y) = (pixel % params.window_width, pixel / params.window_width);
            let at = layer * params.radiance_layer + params.radiance_first + y * params.radiance_row + x;
            let from = &radiance[at as usize];
            counted.rays += u64::from(from.info & !SAMPLE_BAD);
            let place = place_of(pixel, params);
            let half = &mut film[index(place)].halves[(sample & 1) as usize];
            let fault = match from.info & SAMPLE_BAD == 0 {
                true => add(half, from, params.exponent).map(|kind| (kind, UNKNOWN_BOUNCE, NO_MATERIAL)),
                false => Some((from.rgb.x as u32, from.rgb.y as u32, from.rgb.z as u32)),
            };
            let Some((kind, bounce, material)) = fault else { continue };
            half.bad += 1;
            let pixel = (place.y + params.window_y) * params.film_width + place.x + params.window_x;
            counted.bad.push(BadSample { pixel, sample, bounce, material, kind });
        }
    }
    counted
}

/// Where a pixel of the batch is, from its first one.
fn place_of(pixel: u32, params: &AccumulateParams) -> UVec2 {
    UVec2::new(pixel % params.window_width, pixel / params.window_width)
        << UVec2::new(params.column_shift, params.row_shift)
}

/// Adds a sample, or says what is wrong with it.
fn add(half: &mut FilmHalf, from: &RadianceSample, exponent: i32) -> Option<u32> {
    let rgb = from.rgb.to_array();
    if let Some(kind) = rgb.into_iter().find_map(fault) {
        return Some(kind);
    }
    let mut sums = half.sum;
    for (sum, value) in sums.iter_mut().zip(rgb) {
        match fixed_point(value, exponent).and_then(|addend| join(*sum).checked_add(addend)) {
            Some(total) => *sum = split(total),
            None => return Some(BAD_OVERFLOW),
        }
    }
    half.sum = sums;
    half.count += 1;
    None
}

fn fault(x: f32) -> Option<u32> {
    match x {
        _ if x.is_nan() => Some(BAD_NAN),
        _ if x.is_infinite() => Some(BAD_INFINITE),
        _ if x < 0.0 => Some(BAD_NEGATIVE),
        _ => None,
    }
}

/// x * 2^exponent to the nearest whole number, ties up; none from 2^56 on. `x` finite, at least 0.
pub fn fixed_point(x: f32, exponent: i32) -> Option<u64> {
    // Exact: f64 has the range, and 24 bits of mantissa leave room for the half.
    let scaled = f64::from(x) * 2f64.powi(exponent);
    (scaled < 2f64.powi(SAMPLE_BITS as i32)).then(|| (scaled + 0.5).floor() as u64)
}

fn join(words: UVec2) -> u64 {
    u64::from(words.y) << 32 | u64::from(words.x)
}

fn split(sum: u64) -> UVec2 {
    UVec2::new(sum as u32, (sum >> 32) as u32)
}

/// Mean radiance of one half of a pixel, and the samples behind it; black without samples.
pub fn half_mean(half: &FilmHalf, exponent: i32) -> ([f64; 3], u32) {
    (half.sum.map(|sum| mean_of(u128::from(join(sum)), half.count, exponent)), half.count)
}

/// Mean radiance of a pixel, and the samples behind it; black without samples.
pub fn pixel_mean(pixel: &FilmPixel, exponent: i32) -> ([f64; 3], u32) {
    let [even, odd] = &pixel.halves;
    let count = even.count + odd.count;
    let sum = |c: usize| u128::from(join(even.sum[c])) + u128::from(join(odd.sum[c]));
    ([0, 1, 2].map(|c| mean_of(sum(c), count, exponent)), count)
}

fn mean_of(sum: u128, count: u32, exponent: i32) -> f64 {
    if count == 0 { 0.0 } else { sum as f64 / f64::from(count) * 2f64.powi(-exponent) }
}

/// Mean over all pixels that have samples; black if none has.
pub fn film_mean(film: &[FilmPixel], exponent: i32) -> [f64; 3] {
    let means = || film.iter().map(|pixel| pixel_mean(pixel, exponent)).filter(|(_, count)| *count > 0);
    let pixels = means().count().max(1) as f64;
    means().fold([0.0; 3], |sum, (mean, _)| [0, 1, 2].map(|c| sum[c] + mean[c] / pixels))
}

/// Pixels on every side whose radiance stands for that of the one in their middle, where an error is made relative.
const REACH: usize = 4;

/// The relMSE that the film's mean is estimated to have: the mean over pixels and channels of var / (radiance^2 + 0.01). `width` is
/// that of the window whose pixels these are, row by row.
///
/// The halves are independent, so (h0 - h1)^2 has the mean s^2 (1 / c0 + 1 / c1) where the mean of both has variance s^2 /
/// (c0 + c1): a quarter of it for equal counts. The radiance is the mean of a square of pixels: by its own pixel's mean a rare
/// bright sample would be in what it is measured by, and hide itself. 0 where no pixel has samples in both halves.
pub fn relative_error(film: &[FilmPixel], width: usize, exponent: i32) -> f64 {
    let means: Vec<_> =
        film.iter().map(|pixel| pixel.halves.each_ref().map(|half| half_mean(half, exponent))).collect();
    let (mut sum, mut terms) = (0.0, 0u64);
    for c in 0..3 {
        let own = means.iter().map(|[(h0, c0), (h1, c1)]| (*c0 > 0 && *c1 > 0).then_some(0.5 * (h0[c] + h1[c])));
        let around = square_means(own, width);
        for ([(h0, c0), (h1, c1)], radiance) in means.iter().zip(around).filter(|(m, _)| m[0].1 > 0 && m[1].1 > 0) {
            let (c0, c1) = (f64::from(*c0), f64::from(*c1));
            let share = c0 * c1 / ((c0 + c1) * (c0 + c1));
            sum += (h0[c] - h1[c]).powi(2) * share / (radiance * radiance + DARK);
            terms += 1;
        }
    }
    sum / terms.max(1) as f64
}

/// The mean of the values that there are within [`REACH`] of each pixel, by columns and then by rows; 0 where there is none.
fn square_means(values: impl Iterator<Item = Option<f64>>, width: usize) -> Vec<f64> {
    let values: Vec<[f64; 2]> = values.map(|value| value.map_or([0.0; 2], |value| [value, 1.0])).collect();
    let width = width.max(1);
    let height = values.len() / width;
    let add = |sum: [f64; 2], value: &[f64; 2]| [sum[0] + value[0], sum[1] + value[1]];
    let near = |at: usize, count: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(count);
    let column = |i: usize| near(i / width, height).fold([0.0; 2], |sum, y| add(sum, &values[y * width + i % width]));
    let columns: Vec<[f64; 2]> = (0..height * width).map(column).collect();
    let square = |i: usize| near(i % width, width).fold([0.0; 2], |sum, x| add(sum, &columns[i / width * width + x]));
    (0..height * width).map(square).map(|[sum, count]| if count > 0.0 { sum / count } else { 0.0 }).collect()
}
