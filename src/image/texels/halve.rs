//! Smaller pictures of pictures: each texel is the mean of those that it stands for, as light where codes are sRGB's.

use glam::UVec2;

use crate::components::{Texels, TextureImage};
use crate::image::srgb::{srgb_decode, srgb_encode};

/// What codes of red, green and blue, or grey, say. Those of alpha are proportional.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Codes {
    /// Light, by sRGB's curve.
    Srgb,
    /// What they are proportional to.
    Linear,
}

/// The picture with its sides halved so many times, each to 1 texel at least.
pub fn halve(image: &TextureImage, times: u32, codes: Codes) -> TextureImage {
    let size = image.size.map(|side| side.checked_shr(times).unwrap_or(0).max(1));
    let byte = Curve::new(255, codes);
    let word = || Curve::new(65535, codes);
    let texels = match &image.texels {
        Texels::Grey8(texels) => {
            Texels::Grey8(reduced(image.size, size, |at| [byte.decode(texels[at].into())], |[v]| byte.encode(v) as u8))
        }
        Texels::Rgba8(texels) => {
            let decode = |at: usize| {
                let [r, g, b, a] = texels[at].map(usize::from);
                [byte.decode(r), byte.decode(g), byte.decode(b), a as f32 / 255.0]
            };
            let alpha = |a: f32| (a * 255.0).round() as u8;
            let encode =
                |[r, g, b, a]: [f32; 4]| [byte.encode(r) as u8, byte.encode(g) as u8, byte.encode(b) as u8, alpha(a)];
            Texels::Rgba8(reduced(image.size, size, decode, encode))
        }
        Texels::Grey16(texels) => {
            let word = word();
            let encode = |[v]: [f32; 1]| word.encode(v) as u16;
            Texels::Grey16(reduced(image.size, size, |at| [word.decode(texels[at].into())], encode))
        }
        Texels::Rgba16(texels) => {
            let word = word();
            let decode = |at: usize| {
                let [r, g, b, a] = texels[at].map(usize::from);
                [word.decode(r), word.decode(g), word.decode(b), a as f32 / 65535.0]
            };
            let alpha = |a: f32| (a * 65535.0).round() as u16;
            let encode = |[r, g, b, a]: [f32; 4]| {
                [word.encode(r) as u16, word.encode(g) as u16, word.encode(b) as u16, alpha(a)]
            };
            Texels::Rgba16(reduced(image.size, size, decode, encode))
        }
        Texels::Float(texels) => Texels::Float(reduced(image.size, size, |at| texels[at], |value| value)),
    };
    TextureImage { size, texels }
}

/// Codes of 0 to a highest as values of 0 to 1, and back.
struct Curve {
    values: Vec<f32>,
    codes: Codes,
}

impl Curve {
    fn new(highest: u32, codes: Codes) -> Self {
        let value = |code: u32| f64::from(code) / f64::from(highest);
        let decode = |code: u32| if codes == Codes::Srgb { srgb_decode(value(code)) } else { value(code) };
        Self { values: (0..=highest).map(|code| decode(code) as f32).collect(), codes }
    }

    fn decode(&self, code: usize) -> f32 {
        self.values[code]
    }

    fn encode(&self, value: f32) -> u32 {
        let value = f64::from(value).clamp(0.0, 1.0);
        let value = if self.codes == Codes::Srgb { srgb_encode(value) } else { value };
        (value * (self.values.len() - 1) as f64).round() as u32
    }
}

/// Means over the cells of a coarser grid; texels that two cells share count for each by the part that is in it.
fn reduced<const N: usize, T>(
    from: UVec2,
    to: UVec2,
    decode: impl Fn(usize) -> [f32; N],
    encode: impl Fn([f32; N]) -> T,
) -> Vec<T> {
    let (columns, rows) = (cells(from.x, to.x), cells(from.y, to.y));
    let mut texels = Vec::with_capacity(to.x as usize * to.y as usize);
    for row in &rows {
        for column in &columns {
            let mut sum = [0.0; N];
            for (y, height) in row {
                for (x, width) in column {
                    let value = decode(y * from.x as usize + x);
                    for (sum, value) in sum.iter_mut().zip(value) {
                        *sum += width * height * value;
                    }
                }
            }
            texels.push(encode(sum));
        }
    }
    texels
}

/// For each of `to` cells along a side of `from` texels: the texels that it covers, and what part of it each is.
fn cells(from: u32, to: u32) -> Vec<Vec<(usize, f32)>> {
    let scale = f64::from(from) / f64::from(to);
    let cell = |cell: u32| {
        let (low, high) = (f64::from(cell) * scale, (f64::from(cell + 1) * scale).min(from.into()));
        let part = |texel: usize| (high.min(texel as f64 + 1.0) - low.max(texel as f64)).max(0.0) / scale;
        let texels = low as usize..(high.ceil() as usize).min(from as usize);
        texels.map(|texel| (texel, part(texel) as f32)).collect()
    };
    (0..to).map(cell).collect()
}
