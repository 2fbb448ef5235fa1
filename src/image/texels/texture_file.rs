//! A picture file as a texture: what its header says, and its texels.

use std::io::Read;
use std::path::{Path, PathBuf};

use glam::UVec2;
use image::ColorType;

use super::decoder::{self, Format};
use super::expand::Unread;
use super::read_texture::{Alpha, ReadTexture};
use super::{expand, float, jpeg, tiff};
use crate::components::{Render, Texels, TextureImage};
use crate::image::error::{Fault, ReadError};
use crate::image::picture_file::PictureFile;
use crate::image::tail::Tail;
use crate::image::{exr, hdr, png};

/// Bytes of the texels of one picture, at most.
const MOST_BYTES: u64 = 4 << 30;

/// Bytes from the start of a file that tell what it is.
const START: u64 = 4096;

/// No format but some has more bytes of texels for a byte of the file: deflate ends at 1032, a JPEG's blocks at 1400.
const MOST_PACKED: u64 = 4096;

/// What a texture may be, for those whose file is none.
const KINDS: &str = "PNG, JPEG, TGA, BMP, WebP, TIFF, EXR and Radiance HDR";

/// A picture whose texels have not been read.
#[derive(Debug)]
pub struct TextureFile {
    pub path: PathBuf,
    /// Texels, each side 1 to [`Render::MAX_TEXTURE`].
    pub size: UVec2,
    /// Bytes of the texels, at most 4 GiB.
    pub bytes: u64,
    /// What may not be as it was meant, where it is read for colours.
    pub colours: Vec<String>,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    /// Codes, or floats of a TIFF file.
    Codes(Format, ColorType),
    /// EXR or Radiance HDR.
    Float(Box<PictureFile>),
}

impl TextureFile {
    /// Reads the header. What the file is, its first bytes say, not its name; but TGA files have none, and count by their name.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        Self::header(path).map_err(|fault| ReadError { path: path.to_path_buf(), fault })
    }

    fn header(path: &Path) -> Result<Self, Fault> {
        let mut start = Vec::new();
        let mut file = Tail::open(path)?;
        file.by_ref().take(START).read_to_end(&mut start).map_err(Fault::Open)?;
        let length = file.length()?;
        if start.is_empty() {
            return Err(Fault::Empty);
        }
        if start.starts_with(&exr::MAGIC) || hdr::is_hdr(&start) {
            let mut picture = PictureFile::header(path)?;
            check(picture.size, count(picture.size).saturating_mul(16))?;
            if start.starts_with(&exr::MAGIC) {
                check_length(count(picture.size) * 4, length)?;
            }
            let (size, colours) = (picture.size, std::mem::take(&mut picture.warnings));
            let kind = Kind::Float(Box::new(picture));
            return Ok(Self { path: path.to_path_buf(), size, bytes: count(size) * 16, colours, kind });
        }
        let Some(format) = Format::of(&start, path) else { return Err(unknown(&start)) };
        if format == Format::WebP && riff_length(&start) > length + 1 {
            return Err(Fault::CutShort);
        }
        if format == Format::Tiff {
            tiff::check_tables(path)?;
        }
        let mut file = Tail::open(path)?;
        let header = decoder::open(format, &mut file, length, |decoder| (decoder.dimensions(), decoder.color_type()));
        let ((width, height), colour) = match header {
            Ok(header) => header,
            Err(_) if format == Format::Jpeg && !jpeg::is_whole(path)? => return Err(Fault::CutShort),
            Err(error) => return Err(decoder::fault(format, &file, error)),
        };
        let size = UVec2::new(width, height);
        let bytes = count(size).saturating_mul(expand::bytes(colour)?);
        check(size, bytes)?;
        if format != Format::WebP {
            check_length(count(size) * u64::from(colour.bytes_per_pixel()), length)?;
        }
        let colours = if format == Format::Png { png::read_header(path)?.warnings } else { Vec::new() };
        Ok(Self { path: path.to_path_buf(), size, bytes, colours, kind: Kind::Codes(format, colour) })
    }

    /// Reads the texels.
    pub fn read(self) -> Result<ReadTexture, ReadError> {
        let path = self.path.clone();
        self.texels().map_err(|fault| ReadError { path, fault })
    }

    fn texels(self) -> Result<ReadTexture, Fault> {
        let Self { path, size, colours, kind, .. } = self;
        let warnings = Vec::new();
        let mut read = match kind {
            Kind::Float(picture) => {
                let mut texels = picture.read_with_alpha().map_err(|error| error.fault)?;
                let alpha = if picture.has_alpha() { float::judge_alpha(&mut texels) } else { Alpha::None };
                let image = TextureImage { size, texels: Texels::Float(texels) };
                ReadTexture { image, alpha, mended: 0, warnings, colours }
            }
            Kind::Codes(format, colour) => {
                let texels = codes(&path, format, size, colour)?;
                let image = TextureImage { size, texels };
                let mut read =
                    ReadTexture { alpha: expand::alpha(&image.texels, colour), image, mended: 0, warnings, colours };
                if format == Format::Jpeg && !jpeg::is_whole(&path)? {
                    read.warnings.push("its end is missing: what it lacks is grey".to_owned());
                }
                if format == Format::Tga {
                    expand::fill_unused_alpha(&mut read);
                }
                read
            }
        };
        if let Texels::Float(texels) = &mut read.image.texels {
            read.mended = float::mend(texels);
        }
        Ok(read)
    }
}

/// The texels of a file that a decoder reads.
fn codes(path: &Path, format: Format, size: UVec2, colour: ColorType) -> Result<Texels, Fault> {
    let mut file = Tail::open(path)?;
    let length = file.length()?;
    let texels = decoder::open(format, &mut file, length, |decoder| {
        let same = (decoder.dimensions(), decoder.color_type()) == (size.into(), colour);
        if same { expand::read(decoder, size, colour) } else { Err(Unread::Changed) }
    });
    match texels.map_err(Unread::Decoder).flatten() {
        Ok(texels) => Ok(texels),
        Err(Unread::Changed) => Err(Fault::Broken("it was saved while it was read".to_owned())),
        Err(Unread::Memory) => Err(too_heavy(size, count(size) * expand::bytes(colour)?)),
        Err(Unread::Decoder(_)) if format == Format::Jpeg && !jpeg::is_whole(path)? => Err(Fault::CutShort),
        Err(Unread::Decoder(error)) => Err(decoder::fault(format, &file, error)),
    }
}

fn too_heavy(size: UVec2, bytes: u64) -> Fault {
    Fault::TooHeavy { size, gib: bytes as f64 / (1u64 << 30) as f64 }
}

fn count(size: UVec2) -> u64 {
    u64::from(size.x) * u64::from(size.y)
}

fn check(size: UVec2, bytes: u64) -> Result<(), Fault> {
    let most = Render::MAX_TEXTURE;
    match size.min_element() >= 1 && size.max_element() <= most {
        false => Err(Fault::TooLarge { size, most }),
        true if bytes > MOST_BYTES => Err(too_heavy(size, bytes)),
        true => Ok(()),
    }
}

/// Refuses what is too short to hold all that its header says, before memory is taken for it.
fn check_length(bytes: u64, length: u64) -> Result<(), Fault> {
    if bytes / MOST_PACKED <= length { Ok(()) } else { Err(Fault::CutShort) }
}

/// Bytes that a RIFF file says it has; the last of them may be one that only fills.
fn riff_length(start: &[u8]) -> u64 {
    let says = start.get(4..8).and_then(|bytes| bytes.try_into().ok()).map_or(0, u32::from_le_bytes);
    u64::from(says) + 8
}

/// Why a file is none of the kinds.
fn unknown(start: &[u8]) -> Fault {
    let begins = |magic: &[u8]| magic.starts_with(start);
    let riff = start.starts_with(b"RIFF") && start.len() < 12;
    match riff || begins(&exr::MAGIC) || begins(hdr::MAGIC) || decoder::MAGICS.iter().any(|(magic, _)| begins(magic)) {
        true => Fault::CutShort,
        false => Fault::Unknown { kinds: KINDS, text: std::str::from_utf8(start).is_ok() },
    }
}
