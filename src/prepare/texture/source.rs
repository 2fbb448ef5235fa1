//! Texels as their picture has them, and what they are worth.

use crate::components::{Channel, Reading, Texels, Texture};
use crate::image::srgb::srgb_decode;
use crate::layout::trace::luminance;

/// Reads texels of a texture as linear numbers.
pub struct Source<'a> {
    texture: &'a Texture,
    /// What each code of a colour is worth.
    codes: Vec<f32>,
    most: f32,
}

impl<'a> Source<'a> {
    pub fn new(texture: &'a Texture) -> Self {
        let most: u32 = match &texture.image.texels {
            Texels::Rgba8(_) | Texels::Grey8(_) => 255,
            Texels::Rgba16(_) | Texels::Grey16(_) => 65_535,
            Texels::Float(_) => 1,
        };
        let srgb = texture.reading == Reading::Colour;
        let worth = |code: u32| {
            let part = f64::from(code) / f64::from(most);
            (if srgb { srgb_decode(part) } else { part }) as f32
        };
        Self { texture, codes: (0..=most).map(worth).collect(), most: most as f32 }
    }

    /// Red, green, blue and alpha, linear.
    pub fn rgba(&self, x: u32, y: u32) -> [f32; 4] {
        let at = y as usize * self.texture.image.size.x as usize + x as usize;
        let worth = |code: u32| self.codes[code as usize];
        let grey = |code: u32| [worth(code), worth(code), worth(code), 1.0];
        let colour = |[r, g, b, a]: [u32; 4]| [worth(r), worth(g), worth(b), a as f32 / self.most];
        match &self.texture.image.texels {
            Texels::Rgba8(texels) => colour(texels[at].map(u32::from)),
            Texels::Grey8(texels) => grey(texels[at].into()),
            Texels::Grey16(texels) => grey(texels[at].into()),
            Texels::Rgba16(texels) => colour(texels[at].map(u32::from)),
            Texels::Float(texels) => texels[at],
        }
    }

    /// One channel.
    pub fn channel(&self, channel: Channel, x: u32, y: u32) -> f32 {
        let [r, g, b, a] = self.rgba(x, y);
        match channel {
            Channel::Red => r,
            Channel::Green => g,
            Channel::Blue => b,
            Channel::Alpha => a,
            Channel::Luminance => luminance(glam::Vec3::new(r, g, b)),
        }
    }
}
