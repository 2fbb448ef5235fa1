//! The picture with its differing blocks marked.

use glam::UVec2;

use crate::image::srgb::srgb_byte;
use crate::stats::equal_means::{Difference, Means};

/// Frames of blocks that became brighter, and of those that became darker: apart for every kind of eye.
const BRIGHTER: [u8; 4] = [230, 97, 1, 255];
const DARKER: [u8; 4] = [64, 176, 255, 255];

/// A picture of linear radiance as sRGB, with a frame in every block that differs. `size` is that of the picture, `scale` multiplies radiance.
pub fn marked(picture: &[[f32; 3]], size: UVec2, scale: f64, means: &Means) -> Vec<[u8; 4]> {
    let byte = |channel: f32| srgb_byte(f64::from(channel) * scale);
    let mut shown: Vec<[u8; 4]> = picture.iter().map(|[r, g, b]| [byte(*r), byte(*g), byte(*b), 255]).collect();
    for block in means.differing() {
        frame(&mut shown, size.x, block);
    }
    shown
}

/// Colours the outermost pixels of a block.
fn frame(shown: &mut [[u8; 4]], width: u32, block: &Difference) {
    let colour = if block.difference > 0.0 { BRIGHTER } else { DARKER };
    for y in block.min.y..block.max.y {
        for x in block.min.x..block.max.x {
            let edge = x == block.min.x || y == block.min.y || x + 1 == block.max.x || y + 1 == block.max.y;
            if let Some(pixel) = shown.get_mut((y * width + x) as usize).filter(|_| edge) {
                *pixel = colour;
            }
        }
    }
}
