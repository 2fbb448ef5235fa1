//! The display pass: the film's mean, exposed, as 8-bit sRGB. The twin of `passes/display/display`.

use crate::layout::film::{DisplayParams, FilmPixel};

/// A picture word a pixel: r in the lowest byte, a = 255 in the highest.
pub fn display(film: &[FilmPixel], params: &DisplayParams) -> Vec<u32> {
    film.iter().take(params.pixels as usize).map(|pixel| word(pixel, params.scale)).collect()
}

/// One channel, linear to encoded; both 0 to 1 (IEC 61966-2-1).
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// One channel, encoded to linear; both 0 to 1 (IEC 61966-2-1).
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// One channel, linear to 8 bits of sRGB, clamped and rounded.
pub fn srgb_byte(linear: f64) -> u8 {
    (srgb_encode(linear.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8
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
