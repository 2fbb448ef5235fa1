//! Model films, whose pixels' means and variances are known.

use glam::UVec2;
use lucerna::cpu::film::{fixed_point, pixel_mean};
use lucerna::cpu::film_error::{FilmError, Place, film_error};
use lucerna::layout::film::{FilmHalf, FilmPixel};
use lucerna::scene::generate::SplitMix;

pub const EXPONENT: i32 = 40;

/// Radiance of the lamp in the picture.
const LAMP: f64 = 8.0;

/// Part of a pixel at the lamp's border that the lamp covers.
const COVERED: f64 = 0.3;

/// How the samples of a pixel vary about its mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tail {
    /// Evenly from 0 to twice the mean.
    Light,
    /// One in a hundred is forty times as bright, the others are dimmer.
    Heavy,
    /// Half of each sample is that of its tile.
    Shared,
}

impl Tail {
    /// A factor of mean 1.
    fn draw(self, random: &mut SplitMix, tile: f64) -> f64 {
        match self {
            Self::Light => random.range(0.0, 2.0),
            Self::Heavy if random.unit() < 0.01 => 40.0,
            Self::Heavy => random.range(0.0, 2.0 * 0.6 / 0.99),
            Self::Shared => 0.5 * random.range(0.0, 2.0) + 0.5 * tile,
        }
    }

    fn variance(self) -> f64 {
        match self {
            Self::Light => 1.0 / 3.0,
            Self::Heavy => 0.01 * 1600.0 + (0.6f64 / 0.99).powi(2) * 4.0 / 3.0 * 0.99 - 1.0,
            Self::Shared => 1.0 / 6.0,
        }
    }
}

/// A grey picture of 96 by 96 pixels: a slope, a dark half, and a lamp.
pub struct Model {
    pub tail: Tail,
    pub film: Vec<FilmPixel>,
    spp: u32,
    random: SplitMix,
    /// Which pixel of each quad is of which tile.
    dealt: Vec<[usize; 4]>,
}

pub const SIDE: usize = 96;

impl Model {
    pub fn new(tail: Tail, seed: u64) -> Self {
        let mut random = SplitMix(seed);
        let mut deal = || {
            let mut tiles = [0, 1, 2, 3];
            (1..4).for_each(|i| tiles.swap(i, random.next_u64() as usize % (i + 1)));
            tiles
        };
        let dealt = (0..SIDE * SIDE / 4).map(|_| deal()).collect();
        Self { tail, film: vec![FilmPixel::default(); SIDE * SIDE], spp: 0, random, dealt }
    }

    /// What is there but for the lamp, and how much of the pixel the lamp covers.
    fn parts(at: usize) -> (f64, f64) {
        let (x, y) = (at % SIDE, at / SIDE);
        let base = if y < SIDE / 2 { 0.2 + 0.01 * x as f64 } else { 0.05 };
        let within = |low: usize, high: usize| (low..high).contains(&x) && (low..high).contains(&y);
        match (within(11, 19), within(10, 20)) {
            (true, _) => (base, 1.0),
            (false, true) => (base, COVERED),
            (false, false) => (base, 0.0),
        }
    }

    /// The mean of a pixel, and the variance of a sample.
    pub fn truth(&self, at: usize) -> (f64, f64) {
        let (base, lamp) = Self::parts(at);
        let square = (1.0 - lamp) * base * base * (1.0 + self.tail.variance()) + lamp * LAMP * LAMP;
        let mean = (1.0 - lamp) * base + lamp * LAMP;
        (mean, square - mean * mean)
    }

    /// Traces until every pixel has so many samples.
    pub fn trace(&mut self, spp: u32) {
        while self.spp < spp {
            let tiles: Vec<f64> = (0..SIDE * SIDE / 16).map(|_| self.random.range(0.0, 2.0)).collect();
            for at in 0..self.film.len() {
                let (x, y) = (at % SIDE, at / SIDE);
                let place = self.dealt[y / 2 * (SIDE / 2) + x / 2][y % 2 * 2 + x % 2];
                let tile = tiles[4 * (y / 8 * (SIDE / 8) + x / 8) + place];
                let (base, lamp) = Self::parts(at);
                let value = match lamp > 0.0 && self.random.unit() < lamp {
                    true => LAMP,
                    false => base * self.tail.draw(&mut self.random, tile),
                };
                add(&mut self.film[at].halves[(self.spp % 2) as usize], [value; 3]);
            }
            self.spp += 1;
        }
    }

    /// What the film tells of its error.
    pub fn told(&self) -> FilmError {
        film_error(&self.film, Place { min: UVec2::ZERO, width: SIDE }, EXPONENT)
    }

    /// The film's relMSE.
    pub fn true_error(&self) -> f64 {
        let pixels = self.film.iter().enumerate();
        let errors = pixels.map(|(at, pixel)| {
            let (mean, _) = self.truth(at);
            (pixel_mean(pixel, EXPONENT).0[0] - mean).powi(2) / (mean * mean + 0.01)
        });
        errors.sum::<f64>() / self.film.len() as f64
    }

    /// The relMSE of a film of one sample, on average; it falls as 1 / samples.
    pub fn error_of_one(&self) -> f64 {
        let of = |at| {
            let (mean, variance) = self.truth(at);
            variance / (mean * mean + 0.01)
        };
        (0..self.film.len()).map(of).sum::<f64>() / self.film.len() as f64
    }
}

/// A pixel of some samples.
pub fn pixel_of(samples: &[[f64; 3]]) -> FilmPixel {
    let mut pixel = FilmPixel::default();
    samples.iter().enumerate().for_each(|(number, sample)| add(&mut pixel.halves[number % 2], *sample));
    pixel
}

fn add(half: &mut FilmHalf, sample: [f64; 3]) {
    for (sum, value) in half.sum.iter_mut().zip(sample) {
        let total = (u64::from(sum.y) << 32 | u64::from(sum.x)) + fixed_point(value as f32, EXPONENT).unwrap();
        *sum = UVec2::new(total as u32, (total >> 32) as u32);
    }
    half.count += 1;
}
