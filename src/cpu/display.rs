//! The display pass: the film's mean, exposed, as 8-bit sRGB. The twin of `passes/display/display`.

use crate::image::srgb::srgb_byte;
use crate::layout::film::{DisplayParams, FilmPixel};

/// A picture word a pixel: r in the lowest byte, a = 255 in the highest.
pub fn display(film: &[FilmPixel], params: &DisplayParams) -> Vec<u32> {
    film.iter().take(params.pixels as usize).map(|pixel| word(pixel, params.scale)).collect()
}

fn word(pixel: &FilmPixel, scale: f32) -> u32 {
    let [even, odd] = &pixel.halves;
    let count = f64::from((even.count + odd.count).max(1));
    (0..3).fold(0xff00_0000, |word, c| {
        let sum = [even, odd].map(|half| f64::from(half.sum[c].y) * 2f64.powi(32) + f64::from(half.sum[c].x));
        let linear = (sum[0] + sum[1]) / count * f64::from(scale);
        word | u32::from(srgb_byte(linear)) << (8 * c)
    })
}
