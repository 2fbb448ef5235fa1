//! Texels that are numbers, not codes.

use glam::UVec2;

use crate::components::{Texels, TextureImage};
use crate::image::Pixel;

/// The largest value of a texel: that of a half.
const MOST: f32 = 65504.0;

/// A picture of these pixels, opaque.
pub fn image(size: UVec2, pixels: Vec<Pixel>) -> TextureImage {
    TextureImage { size, texels: Texels::Float(pixels.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect()) }
}

/// Makes every value finite and at least 0. Says how many texels had one that was not.
pub fn mend(texels: &mut [[f32; 4]]) -> u64 {
    let mut mended = 0;
    for texel in texels {
        let good = texel.map(|value| if value.is_nan() { 0.0 } else { value.clamp(0.0, MOST) });
        mended += u64::from(good != *texel);
        *texel = good;
    }
    mended
}
