//! Writes a finished film as PNG, EXR or JSON.

use std::fs::File;
use std::io::{BufWriter, Seek, Write};
use std::path::PathBuf;

use exr::image::{Encoding, Image, Layer, SpecificChannels};
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, IntegerBounds, Text};
use exr::meta::header::LayerAttributes;
use glam::UVec2;

use super::exr::METADATA;
use super::file::{self, SaveError};
use crate::components::Crop;

/// What can be written about a render.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// The whole picture, pixels.
    pub size: UVec2,
    /// The rendered rectangle within it.
    pub window: Crop,
    /// Linear Rec.709 radiance of the window, row by row from the top.
    pub linear: &'a [[f32; 3]],
    /// The window as it is shown: sRGB, 8 bits, the fourth is ignored.
    pub display: &'a [[u8; 4]],
    /// What is needed to repeat the render, as keys and values; written into PNG and EXR.
    pub metadata: &'a [(&'static str, String)],
    /// The report: the content of a JSON output.
    pub report: &'a serde_json::Value,
}

/// A kind of file, chosen by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// What the display pass made, 8-bit sRGB.
    Png,
    /// Linear 32-bit floats.
    Exr,
    /// The report alone.
    Json,
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// Where, as the user named it.
    pub path: PathBuf,
    pub kind: Kind,
}

impl Output {
    /// Chooses the kind by the extension, in either case of letters.
    pub fn new(path: impl Into<PathBuf>) -> Result<Self, SaveError> {
        let path = path.into();
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let kind = match extension.as_deref() {
            Some("png") => Kind::Png,
            Some("exr") => Kind::Exr,
            Some("json") => Kind::Json,
            _ => return Err(SaveError::Extension(path)),
        };
        Ok(Self { path, kind })
    }

    /// Tries whether the file can be written, so that long work can't end in a refusal; refuses to write over one that is `read`.
    pub fn prepare(&self, read: &[PathBuf]) -> Result<(), SaveError> {
        let place = file::prepare(&self.path)?;
        if file::is_among(&place, read) { Err(SaveError::Input(self.path.clone())) } else { Ok(()) }
    }

    /// Writes the picture as its kind of file.
    pub fn write(&self, picture: &Picture) -> Result<(), SaveError> {
        self.write_by(|out| match self.kind {
            Kind::Png => write_png(picture, out),
            Kind::Exr => write_exr(picture, out),
            Kind::Json => {
                serde_json::to_writer_pretty(&mut *out, picture.report)?;
                out.write_all(b"\n")
            }
        })
    }

    /// Writes the file by `content`, whole.
    pub fn write_by(
        &self,
        content: impl FnOnce(&mut BufWriter<&File>) -> std::io::Result<()>,
    ) -> Result<(), SaveError> {
        file::write(&self.path, content)
    }
}

/// 8-bit sRGB of the window, with the metadata as text.
fn write_png(picture: &Picture, out: &mut impl Write) -> std::io::Result<()> {
    let size = picture.window.size();
    let mut encoder = png::Encoder::new(out, size.x, size.y);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // Pictures of noise hardly get smaller by more effort.
    encoder.set_compression(png::Compression::Fast);
    for (key, value) in picture.metadata {
        let (key, value) = ((*key).to_owned(), value.clone());
        // A tEXt chunk is Latin-1; names of files need not be.
        let added =
            if value.is_ascii() { encoder.add_text_chunk(key, value) } else { encoder.add_itxt_chunk(key, value) };
        added.map_err(std::io::Error::from)?;
    }
    let mut writer = encoder.write_header()?;
    let pixels: Vec<u8> = picture.display.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(())
}

/// Linear 32-bit floats, R, G and B, losslessly compressed. A crop is the data window within the whole picture's
/// display window. The metadata are one text attribute, `lucerna`: a JSON object in UTF-8. (Several attributes would be
/// written in the order of a hash map, another one in each run.)
fn write_exr(picture: &Picture, out: &mut (impl Write + Seek)) -> std::io::Result<()> {
    let size = picture.window.size();
    let width = size.x as usize;
    let pixel = |at: Vec2<usize>| {
        let [r, g, b] = picture.linear[at.y() * width + at.x()];
        (r, g, b)
    };
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(picture.window.min.x), signed(picture.window.min.y)),
        software_name: Some(Text::from(concat!("Lucerna ", env!("CARGO_PKG_VERSION")))),
        ..LayerAttributes::default()
    };
    let metadata: serde_json::Map<_, _> =
        picture.metadata.iter().map(|(key, value)| ((*key).to_owned(), value.as_str().into())).collect();
    let text = serde_json::Value::Object(metadata).to_string();
    attributes.other.insert(Text::from(METADATA), AttributeValue::Text(Text::from_slice_unchecked(text.as_bytes())));
    let channels = SpecificChannels::rgb(pixel);
    let layer = Layer::new((width, size.y as usize), attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.display_window = IntegerBounds::new((0, 0), (picture.size.x as usize, picture.size.y as usize));
    exr::image::write::WritableImage::write(&image).to_buffered(out).map_err(|error| match error {
        exr::error::Error::Io(source) => source,
        other => std::io::Error::other(other),
    })
}

/// A pixel coordinate, which is at most [`Film::MAX_SIDE`](crate::components::Film::MAX_SIDE).
fn signed(coordinate: u32) -> i32 {
    i32::try_from(coordinate).unwrap_or(i32::MAX)
}
