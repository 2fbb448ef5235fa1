//! Texels that are numbers, not codes.

use super::read_texture::Alpha;

/// The largest value of a texel: that of a half.
const MOST: f32 = 65504.0;

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

/// What alpha says in a picture that has one. Zeros alone are what programs write that have none: they are made opaque.
pub fn judge_alpha(texels: &mut [[f32; 4]]) -> Alpha {
    if texels.iter().all(|[.., alpha]| *alpha == 0.0) {
        texels.iter_mut().for_each(|[.., alpha]| *alpha = 1.0);
        return Alpha::None;
    }
    if texels.iter().all(|[.., alpha]| *alpha >= 1.0) { Alpha::Opaque } else { Alpha::Partial }
}
