//! Whether a picture that is named for heights has directions: many programs write either by the same statement.

use crate::components::{Texels, TextureImage};

/// Texels that are looked at, at most.
const SAMPLES: usize = 4096;

/// Of a hundred texels, how many are to be directions, and how many may be grey.
const DIRECTIONS: usize = 90;
const GREY: usize = 50;

/// Channels that differ by less are those of a grey.
const ALIKE: f32 = 0.04;

/// Whether most texels are unit vectors that point away from the surface, and not grey.
pub fn has_directions(image: &TextureImage) -> bool {
    let count = image.size.x as usize * image.size.y as usize;
    // Not a divisor of sides, which are often powers of two.
    let step = (count / SAMPLES).max(1) | 1;
    let texels: Vec<[f32; 3]> = (0..count).step_by(step).filter_map(|at| colour(&image.texels, at)).collect();
    let part = |is: fn(&[f32; 3]) -> bool| texels.iter().filter(|texel| is(texel)).count() * 100;
    !texels.is_empty() && part(is_direction) >= DIRECTIONS * texels.len() && part(is_grey) < GREY * texels.len()
}

/// The channels of a texel, 0 to 1; none of what has only one.
fn colour(texels: &Texels, at: usize) -> Option<[f32; 3]> {
    match texels {
        Texels::Grey8(_) | Texels::Grey16(_) => None,
        Texels::Rgba8(texels) => texels.get(at).map(|[r, g, b, _]| [r, g, b].map(|code| f32::from(*code) / 255.0)),
        Texels::Rgba16(texels) => texels.get(at).map(|[r, g, b, _]| [r, g, b].map(|code| f32::from(*code) / 65535.0)),
        Texels::Float(texels) => texels.get(at).map(|[r, g, b, _]| [*r, *g, *b]),
    }
}

fn is_direction(texel: &[f32; 3]) -> bool {
    let length = texel.iter().map(|value| (2.0 * value - 1.0).powi(2)).sum::<f32>().sqrt();
    (0.8..=1.2).contains(&length) && texel[2] > 0.5
}

fn is_grey(texel: &[f32; 3]) -> bool {
    let [r, g, b] = *texel;
    r.max(g).max(b) - r.min(g).min(b) < ALIKE
}
