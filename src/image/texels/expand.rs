//! Decoded texels of any kind as the few kinds that a texture has, in the memory that they were decoded to.

use bytemuck::Pod;
use glam::UVec2;
use image::{ColorType, ImageDecoder, ImageError};

use super::read_texture::{Alpha, ReadTexture};
use crate::components::Texels;
use crate::image::error::Fault;

/// Why texels could not be read.
pub enum Unread {
    /// The header was another one a moment ago.
    Changed,
    /// There is no memory for them.
    Memory,
    Decoder(ImageError),
}

/// Bytes of a texel once it is read.
pub fn bytes(colour: ColorType) -> Result<u64, Fault> {
    match colour {
        ColorType::L8 => Ok(1),
        ColorType::L16 => Ok(2),
        ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Ok(4),
        ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Ok(8),
        ColorType::Rgb32F | ColorType::Rgba32F => Ok(16),
        other => Err(Fault::Unsupported {
            what: format!("its pixels are {other:?}, which is not read"),
            help: "write it as PNG, with 8 or 16 bits a channel",
        }),
    }
}

/// Decodes the texels of a picture.
pub fn read(decoder: Box<dyn ImageDecoder + '_>, size: UVec2, colour: ColorType) -> Result<Texels, Unread> {
    let count = size.x as usize * size.y as usize;
    match colour {
        ColorType::L8 => plain(decoder, count).map(Texels::Grey8),
        ColorType::L16 => plain(decoder, count).map(Texels::Grey16),
        ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => {
            expanded(decoder, count, colour, u8::MAX).map(Texels::Rgba8)
        }
        ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            expanded(decoder, count, colour, u16::MAX).map(Texels::Rgba16)
        }
        _ => expanded(decoder, count, colour, 1.0).map(Texels::Float),
    }
}

/// Decodes texels that stay what they are.
fn plain<T: Pod>(decoder: Box<dyn ImageDecoder + '_>, count: usize) -> Result<Vec<T>, Unread> {
    let mut texels = bytemuck::allocation::try_zeroed_vec(count).map_err(|()| Unread::Memory)?;
    decoder.read_image_boxed(bytemuck::cast_slice_mut(&mut texels)).map_err(Unread::Decoder)?;
    Ok(texels)
}

/// Decodes texels of two to four channels into the front of their memory, and moves each to its place, the last one first.
fn expanded<T: Pod>(
    decoder: Box<dyn ImageDecoder + '_>,
    count: usize,
    colour: ColorType,
    opaque: T,
) -> Result<Vec<[T; 4]>, Unread> {
    let channels = usize::from(colour.channel_count());
    let mut texels = bytemuck::allocation::try_zeroed_vec(count).map_err(|()| Unread::Memory)?;
    let values: &mut [T] = bytemuck::cast_slice_mut(&mut texels);
    decoder.read_image_boxed(bytemuck::cast_slice_mut(&mut values[..count * channels])).map_err(Unread::Decoder)?;
    if channels < 4 {
        for texel in (0..count).rev() {
            let at = texel * channels;
            let [a, b] = [values[at], values[at + 1]];
            let whole = if channels == 2 { [a, a, a, b] } else { [a, b, values[at + 2], opaque] };
            values[4 * texel..4 * texel + 4].copy_from_slice(&whole);
        }
    }
    Ok(texels)
}

/// What the alpha of texels says that were of such a colour in their file.
pub fn alpha(texels: &Texels, colour: ColorType) -> Alpha {
    let opaque = match texels {
        _ if !colour.has_alpha() => return Alpha::None,
        Texels::Rgba8(texels) => texels.iter().all(|texel| texel[3] == u8::MAX),
        Texels::Rgba16(texels) => texels.iter().all(|texel| texel[3] == u16::MAX),
        Texels::Float(texels) => texels.iter().all(|texel| texel[3] >= 1.0),
        Texels::Grey8(_) | Texels::Grey16(_) => return Alpha::None,
    };
    if opaque { Alpha::Opaque } else { Alpha::Partial }
}

/// Makes opaque what programs that have no alpha write in its place: zeros alone.
pub fn fill_unused_alpha(read: &mut ReadTexture) {
    if let Texels::Rgba8(texels) = &mut read.image.texels
        && read.alpha == Alpha::Partial
        && texels.iter().all(|texel| texel[3] == 0)
    {
        texels.iter_mut().for_each(|texel| texel[3] = u8::MAX);
        read.alpha = Alpha::None;
    }
}
