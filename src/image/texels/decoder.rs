//! The decoders of the image crate, by what a file begins with.

use std::io::{BufReader, Seek};
use std::path::Path;

use image::codecs::bmp::BmpDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::tga::TgaDecoder;
use image::codecs::tiff::TiffDecoder;
use image::codecs::webp::WebPDecoder;
use image::{ImageDecoder, ImageError, ImageResult, Limits};

use crate::image::error::Fault;
use crate::image::png;
use crate::image::tail::Tail;

/// Bytes that a decoder may take beside what the picture and the file take.
const BESIDE: u64 = 32 << 20;

/// Endings of TGA files, in small letters.
const TGA: [&str; 4] = ["tga", "icb", "vda", "vst"];

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Png,
    Jpeg,
    Tga,
    Bmp,
    WebP,
    Tiff,
}

/// First bytes of files; WebP's are those of any RIFF file.
pub const MAGICS: [(&[u8], Format); 7] = [
    (&png::MAGIC, Format::Png),
    (b"\xff\xd8\xff", Format::Jpeg),
    (b"BM", Format::Bmp),
    (b"RIFF", Format::WebP),
    (b"II*\0", Format::Tiff),
    (b"MM\0*", Format::Tiff),
    (b"II+\0", Format::Tiff),
];

impl Format {
    /// Of a file that begins so; of TGA, by the ending of its name, where it is nothing else.
    pub fn of(start: &[u8], path: &Path) -> Option<Self> {
        let known = MAGICS.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, format)| *format);
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match known {
            Some(Self::WebP) if !start.get(8..).is_some_and(|rest| rest.starts_with(b"WEBP")) => None,
            None if TGA.contains(&ending.as_str()) => Some(Self::Tga),
            known => known,
        }
    }
}

/// Opens a file of so many bytes for its decoder, and has something done with that.
pub fn open<T>(
    format: Format,
    file: &mut Tail,
    length: u64,
    with: impl FnOnce(Box<dyn ImageDecoder + '_>) -> T,
) -> ImageResult<T> {
    file.rewind()?;
    let limits = |bytes: u64| {
        let mut limits = Limits::no_limits();
        // Once for the texels, and once for strips or rows of them.
        limits.max_alloc = Some(bytes.saturating_mul(2).saturating_add(length).saturating_add(BESIDE));
        limits
    };
    let reader = BufReader::new(file);
    Ok(match format {
        Format::Png => with(Box::new(PngDecoder::with_limits(reader, limits(0))?)),
        Format::Jpeg => with(limited(JpegDecoder::new(reader)?, limits)?),
        Format::Tga => with(limited(TgaDecoder::new(reader)?, limits)?),
        Format::Bmp => with(limited(BmpDecoder::new(reader)?, limits)?),
        Format::WebP => with(limited(WebPDecoder::new(reader)?, limits)?),
        Format::Tiff => with(limited(TiffDecoder::new(reader)?, limits)?),
    })
}

fn limited<'a>(
    mut decoder: impl ImageDecoder + 'a,
    limits: impl Fn(u64) -> Limits,
) -> ImageResult<Box<dyn ImageDecoder + 'a>> {
    decoder.set_limits(limits(decoder.total_bytes()))?;
    Ok(Box::new(decoder))
}

/// What a decoder's error means.
pub fn fault(format: Format, file: &Tail, error: ImageError) -> Fault {
    match &error {
        ImageError::IoError(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => Fault::CutShort,
        ImageError::Unsupported(_) => {
            let what = error.to_string();
            Fault::Unsupported { what, help: "write it as PNG, with 8 or 16 bits a channel" }
        }
        // These come to the end of the file in any case.
        _ if matches!(format, Format::Jpeg | Format::WebP) => Fault::Broken(error.to_string()),
        _ => file.fault(error),
    }
}
