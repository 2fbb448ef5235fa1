//! The film on the CPU: the twin of the accumulate pass, and the film's means.

use glam::UVec2;

use crate::layout::adaptive::{TILE_LANES, TileRun, TileSample, unpack_tile};
use crate::layout::film::{AccumulateParams, BadSample, FULL_SUM, FilmHalf, FilmPixel, SAMPLE_BITS, UNKNOWN_BOUNCE};
use crate::layout::trace::{
    BAD_INFINITE, BAD_NAN, BAD_NEGATIVE, BAD_OVERFLOW, NO_MATERIAL, RadianceSample, SAMPLE_BAD, TILE_BLOCK,
};
use crate::parallel;

/// What a batch counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counted {
    pub rays: u64,
    /// Every bad sample, by layer and pixel.
    pub bad: Vec<BadSample>,
    /// Halves of pixels that have become full.
    pub full: u32,
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
            let place = place_of(pixel, params);
            let half = &mut film[index(place)].halves[(sample & 1) as usize];
            counted.add(half, from, params, place, sample);
        }
    }
    counted
}

/// Adds what tiles got, as an adaptive film has it: `samples` are the batch's, 64 places of `radiance` each. The film is the window of `params`.
pub fn accumulate_tiles(
    film: &mut [FilmPixel],
    radiance: &[RadianceSample],
    (samples, runs): (&[TileSample], &[TileRun]),
    params: &AccumulateParams,
) -> Counted {
    let mut counted = Counted::default();
    let min = UVec2::new(params.window_x, params.window_y);
    for run in runs {
        for number in run.first..run.first + run.counts[0] + run.counts[1] {
            let sample = samples[number as usize].sample;
            for lane in 0..TILE_LANES {
                let at = TILE_BLOCK * unpack_tile(run.tile) + UVec2::new(lane % TILE_BLOCK, lane / TILE_BLOCK);
                let place = at.wrapping_sub(min);
                if place.cmpge(UVec2::new(params.window_width, params.window_height)).any() {
                    continue;
                }
                let pixel = &mut film[(place.y * params.row + place.x) as usize];
                let half = &mut pixel.halves[usize::from(number >= run.first + run.counts[0])];
                counted.add(half, &radiance[(number * TILE_LANES + lane) as usize], params, place, sample);
            }
        }
    }
    counted
}

impl Counted {
    /// Adds one sample of a pixel, by its place in the window of `params`, or takes note of what is wrong with it.
    fn add(
        &mut self,
        half: &mut FilmHalf,
        from: &RadianceSample,
        params: &AccumulateParams,
        place: UVec2,
        sample: u32,
    ) {
        self.rays += u64::from(from.info & !SAMPLE_BAD);
        let fault = match from.info & SAMPLE_BAD == 0 {
            true if is_full(half) => None,
            true => {
                let fault = add(half, from, params.exponent).map(|kind| (kind, UNKNOWN_BOUNCE, NO_MATERIAL));
                self.full += u32::from(is_full(half));
                fault
            }
            false => Some((from.rgb.x as u32, from.rgb.y as u32, from.rgb.z as u32)),
        };
        if let Some((kind, bounce, material)) = fault {
            half.bad += 1;
            let pixel = (place.y + params.window_y) * params.film_width + place.x + params.window_x;
            self.bad.push(BadSample { pixel, sample, bounce, material, kind });
        }
    }
}

/// Where a pixel of the batch is, from its first one.
pub(super) fn place_of(pixel: u32, params: &AccumulateParams) -> UVec2 {
    UVec2::new(pixel % params.window_width, pixel / params.window_width)
        << UVec2::new(params.column_shift, params.row_shift)
}

/// Whether a half takes no more samples: another might not fit its sums.
pub(super) fn is_full(half: &FilmHalf) -> bool {
    half.sum.iter().any(|sum| sum.y >= FULL_SUM)
}

/// Adds a sample to a half that is not full, or says what is wrong with it.
pub(super) fn add(half: &mut FilmHalf, from: &RadianceSample, exponent: i32) -> Option<u32> {
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
    let scale = 2f64.powi(-exponent);
    (half.sum.map(|sum| mean_of(join(sum) as f64, half.count, scale)), half.count)
}

/// Mean radiance of a pixel, and the samples behind it; black without samples.
pub fn pixel_mean(pixel: &FilmPixel, exponent: i32) -> ([f64; 3], u32) {
    let [even, odd] = &pixel.halves;
    let (count, scale) = (even.count + odd.count, 2f64.powi(-exponent));
    ([0, 1, 2].map(|c| mean_of(total(join(even.sum[c]), join(odd.sum[c])), count, scale)), count)
}

/// How a pixel's halves become its mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Joined {
    /// Every sample counts alike: nobody's values have settled how many there are.
    #[default]
    BySamples,
    /// Each half counts alike, however many samples it has: the values of each have settled the number of the other
    /// ([`allocation`](crate::cpu::allocation)).
    ByHalves,
}

/// Mean radiance of a pixel whose halves are joined in some way, and the samples behind it; black without samples.
pub fn joined_mean(pixel: &FilmPixel, exponent: i32, joined: Joined) -> ([f64; 3], u32) {
    let [(a, n), (b, m)] = pixel.halves.each_ref().map(|half| half_mean(half, exponent));
    match joined {
        // The mean of the one half that there is, is that of all samples.
        Joined::ByHalves if n > 0 && m > 0 => ([0, 1, 2].map(|c| 0.5 * (a[c] + b[c])), n + m),
        _ => pixel_mean(pixel, exponent),
    }
}

/// The sum of two sums, rounded once.
fn total(a: u64, b: u64) -> f64 {
    a.checked_add(b).map_or_else(|| (u128::from(a) + u128::from(b)) as f64, |sum| sum as f64)
}

fn mean_of(sum: f64, count: u32, scale: f64) -> f64 {
    if count == 0 { 0.0 } else { sum / f64::from(count) * scale }
}

/// Pixels that a thread sums up at once.
const PIECE: usize = 1 << 14;

/// Mean over all pixels that have samples; black if none has.
pub fn film_mean(film: &[FilmPixel], exponent: i32) -> [f64; 3] {
    joined_film_mean(film, exponent, Joined::BySamples)
}

/// The same of pixels whose halves are joined in some way.
pub fn joined_film_mean(film: &[FilmPixel], exponent: i32, joined: Joined) -> [f64; 3] {
    film_sum(film, exponent, joined).mean()
}

/// Pixels that have samples: the sum of their means, and how many there are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmSum {
    sum: [f64; 3],
    pixels: u64,
}

impl FilmSum {
    /// Of the pixels of both.
    pub fn and(self, other: Self) -> Self {
        Self { sum: add_colours(self.sum, other.sum), pixels: self.pixels + other.pixels }
    }

    /// Their mean; black without any.
    pub fn mean(&self) -> [f64; 3] {
        self.sum.map(|channel| channel / self.pixels.max(1) as f64)
    }
}

/// What the mean comes from: of a film that is traced part by part, those of its parts are added up.
pub fn film_sum(film: &[FilmPixel], exponent: i32, joined: Joined) -> FilmSum {
    let piece = |number: usize| {
        let pixels = film.iter().skip(number * PIECE).take(PIECE);
        let means = pixels.map(|pixel| joined_mean(pixel, exponent, joined)).filter(|(_, count)| *count > 0);
        means.fold(FilmSum::default(), |sum, (mean, _)| sum.and(FilmSum { sum: mean, pixels: 1 }))
    };
    let pieces = parallel::map(film.len().div_ceil(PIECE), piece);
    pieces.into_iter().fold(FilmSum::default(), FilmSum::and)
}

fn add_colours(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|c| a[c] + b[c])
}
