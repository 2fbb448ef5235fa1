//! Pictures of light: EXR and Radiance HDR as they are, PNG decoded from sRGB. What a file is, its first bytes say, not its name.

use std::path::Path;

use glam::{UVec2, Vec3};
use image::{ImageReader, Limits};

use crate::components::EnvironmentMap;

/// Pixels a side, at most.
const MOST_SIDE: u32 = 16_384;

/// Bytes that decoding a file may take.
const MOST_BYTES: u64 = 4 << 30;

/// The brightest a channel may be, as for a constant environment.
const BRIGHTEST: f32 = 1e6;

/// A picture, and how many of its pixels were no radiance.
#[derive(Debug)]
pub struct PictureOfLight {
    pub map: EnvironmentMap,
    /// Pixels with a channel that was negative or no number, and is 0; or above 1e6, and is that.
    pub mended: usize,
}

/// Reads a picture; says why if it can't be used.
pub fn read_picture(path: &Path) -> Result<PictureOfLight, String> {
    let start = crate::files::open_regular(path).and_then(|mut file| {
        let mut start = [0; 4];
        std::io::Read::read(&mut file, &mut start).map(|_| start)
    });
    let exr = start.map_err(|error| error.to_string())? == [0x76, 0x2f, 0x31, 0x01];
    let (size, mut pixels) = if exr { read_exr(path)? } else { read_raster(path)? };
    let mut mended = 0;
    for pixel in &mut pixels {
        let good = pixel.map(|channel| if channel.is_nan() { 0.0 } else { channel.clamp(0.0, BRIGHTEST) });
        mended += usize::from(good != *pixel);
        *pixel = good;
    }
    Ok(PictureOfLight { map: EnvironmentMap { size, pixels }, mended })
}

fn check_size(width: u32, height: u32) -> Result<UVec2, String> {
    match width.min(height) >= 1 && width.max(height) <= MOST_SIDE {
        true => Ok(UVec2::new(width, height)),
        false => Err(format!("{width}x{height} pixels: a side has 1 to {MOST_SIDE}")),
    }
}

fn read_exr(path: &Path) -> Result<(UVec2, Vec<Vec3>), String> {
    let image = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| {
            let fits = size.width() <= MOST_SIDE as usize && size.height() <= MOST_SIDE as usize;
            (size.width(), vec![Vec3::ZERO; if fits { size.area() } else { 0 }])
        },
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            if let Some(pixel) = pixels.get_mut(at.y() * *width + at.x()) {
                *pixel = Vec3::new(r, g, b);
            }
        },
    )
    .map_err(|error| error.to_string())?;
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    let size = image.layer_data.size;
    Ok((check_size(side(size.width()), side(size.height()))?, image.layer_data.channel_data.pixels.1))
}

fn read_raster(path: &Path) -> Result<(UVec2, Vec<Vec3>), String> {
    let mut reader =
        ImageReader::open(path).and_then(ImageReader::with_guessed_format).map_err(|error| error.to_string())?;
    let linear = reader.format() == Some(image::ImageFormat::Hdr);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MOST_SIDE), Some(MOST_SIDE));
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| error.to_string())?.into_rgb32f();
    let size = check_size(picture.width(), picture.height())?;
    let decode = |channel: f32| match channel {
        _ if linear => channel,
        c if c <= 0.04045 => c / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    };
    Ok((size, picture.pixels().map(|pixel| Vec3::from(pixel.0.map(decode))).collect()))
}
