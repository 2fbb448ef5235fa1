//! The two means of a pixel, and how much they say of its error.

use crate::cpu::film::{Joined, half_mean};
use crate::layout::film::FilmPixel;

/// A pixel's two means.
#[derive(Clone, Copy, Debug, Default)]
pub struct Halves {
    pub means: [[f64; 3]; 2],
    /// Square root of what the means' squared difference is multiplied by to be the variance of the pixel's mean: 1/2 for halves of as many
    /// samples, and for those that count alike. 0 where one has none, and the pixel says nothing.
    pub share: f64,
}

impl Halves {
    pub fn of(pixel: &FilmPixel, exponent: i32, joined: Joined) -> Self {
        let [(h0, c0), (h1, c1)] = pixel.halves.each_ref().map(|half| half_mean(half, exponent));
        if c0 == 0 || c1 == 0 {
            return Self::default();
        }
        let (c0, c1) = (f64::from(c0), f64::from(c1));
        let share = match joined {
            Joined::BySamples => (c0 * c1).sqrt() / (c0 + c1),
            Joined::ByHalves => 0.5,
        };
        Self { means: [h0, h1], share }
    }

    pub fn is_there(&self) -> bool {
        self.share > 0.0
    }

    /// The error that a channel's mean shows, with the sign of the first half's.
    pub fn error(&self, channel: usize) -> f64 {
        self.share * (self.means[0][channel] - self.means[1][channel])
    }
}
