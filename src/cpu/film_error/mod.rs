//! The error of a film, estimated from its two halves, and how sure that is.
//!
//! Halves are independent, with errors e0 and e1. The film's error is (e0 + e1) / 2; what it tells, (e0 - e1) / 2, is as large in the mean,
//! and differs of this very picture by e0 e1 alone. So a rare bright sample, which is in one half, is in both numbers alike.
//! What is left to know is by what a pixel's error is relative (`radiance`), and how far the sum of e0 e1 may be from 0 (`spread`).

mod around;
mod halves;
mod line;
mod radiance;
mod spread;

use std::ops::Range;

use glam::UVec2;

use crate::cpu::film::Joined;
use crate::layout::film::FilmPixel;
use crate::parallel;
use crate::stats::summary::upper_quantile;
use halves::Halves;
use radiance::shares;
use spread::{BLOCK, Spread};

/// Rows that a thread looks at together, of the whole film: whole blocks.
const ROWS: usize = 4 * BLOCK;

/// Rows beyond those that matter for them.
const HALO: usize = radiance::REACH;

/// The probability that a film's relMSE is above what is said of it.
const RISK: f64 = 0.05;

/// What a film tells of its own relMSE: of the mean over pixels and channels of (mean - truth)^2 / (truth^2 + 0.01).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmError {
    /// As likely too small as too large.
    pub relmse: f64,
    /// It is at most this, in 19 of 20 films.
    pub bound: f64,
}

/// Where a film's pixels are: row by row from the top left of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The window's first pixel in the whole film.
    pub min: UVec2,
    /// Pixels of a row.
    pub width: usize,
}

/// The error that a film is estimated to have; 0 where no pixel has samples in both halves.
pub fn film_error(film: &[FilmPixel], place: Place, exponent: i32) -> FilmError {
    joined_film_error(film, place, exponent, Joined::BySamples)
}

/// The same of a film whose halves are joined in some way.
pub fn joined_film_error(film: &[FilmPixel], place: Place, exponent: i32, joined: Joined) -> FilmError {
    error_sums(film, place, exponent, joined).error()
}

/// What that comes from: of a film that is traced part by part, those of its parts are added up.
pub fn error_sums(film: &[FilmPixel], place: Place, exponent: i32, joined: Joined) -> ErrorSums {
    if film.is_empty() || place.width == 0 {
        return ErrorSums::default();
    }
    let height = film.len() / place.width;
    // Rows before the first one of the window, in the whole film's first piece.
    let before = place.min.y as usize % ROWS;
    let piece = |number: usize| {
        let rows = (number * ROWS).saturating_sub(before)..((number + 1) * ROWS - before).min(height);
        piece_error(film, place, rows, (exponent, joined))
    };
    let pieces = parallel::map((before + height).div_ceil(ROWS), piece);
    pieces.into_iter().fold(ErrorSums::default(), ErrorSums::and)
}

/// Of some rows, or of the whole film.
#[derive(Clone, Copy, Debug, Default)]
pub struct ErrorSums {
    /// Squared relative errors.
    error: f64,
    /// Pixels.
    pixels: u64,
    spread: Spread,
}

impl ErrorSums {
    /// Of the pixels of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            error: self.error + other.error,
            pixels: self.pixels + other.pixels,
            spread: self.spread.and(other.spread),
        }
    }

    /// What they say of those pixels together.
    pub fn error(&self) -> FilmError {
        let terms = 3.0 * self.pixels.max(1) as f64;
        let (deviation, blocks) = self.spread.deviation();
        let bound = self.error + deviation * upper_quantile(RISK, blocks);
        FilmError { relmse: self.error / terms, bound: bound / terms }
    }
}

/// Sums over some rows of a film.
fn piece_error(film: &[FilmPixel], place: Place, rows: Range<usize>, (exponent, joined): (i32, Joined)) -> ErrorSums {
    let width = place.width;
    let height = film.len() / width;
    let (low, high) = (rows.start.saturating_sub(HALO), (rows.end + HALO).min(height));
    let halves = film[low * width..high * width].iter().map(|pixel| Halves::of(pixel, exponent, joined));
    let halves: Vec<Halves> = halves.collect();
    let shares = shares(&halves, width, rows.start - low..rows.end - low);
    let there = || shares.iter().filter(|share| share.is_there);
    ErrorSums {
        error: there().map(|share| share.errors.iter().map(|error| error * error).sum::<f64>()).sum(),
        pixels: there().count() as u64,
        spread: Spread::of(&shares, width, place.min + UVec2::new(0, rows.start as u32)),
    }
}
