//! Pictures of any kind as linear pixels: EXR by `exr.rs`, PNG and Radiance HDR here. The size is known before a pixel is read.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use glam::{IVec2, UVec2};
use image::codecs::hdr::HdrDecoder;
use image::codecs::png::PngDecoder;
use image::{ColorType, DynamicImage, ImageDecoder, Limits};

use super::exr::ExrFile;
use crate::components::{Crop, Film};
use crate::cpu::display::srgb_decode;
use crate::files;

/// Linear Rec.709 radiance of a pixel.
pub type Pixel = [f32; 3];

/// Why a picture can't be read. Each names the file and says what to do.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReadError {
    #[error("{}: can't open: {source}", path.display())]
    #[diagnostic(help("name a picture that can be read: .exr, .hdr or .png"))]
    Open { path: PathBuf, source: std::io::Error },
    #[error("{}: is no picture that can be compared", .0.display())]
    #[diagnostic(help("EXR, Radiance HDR and PNG are read, whatever the name ends in"))]
    Unknown(PathBuf),
    #[error("{}: can't read: {why}", path.display())]
    #[diagnostic(help("the file is cut short, damaged, or of a variant that is not read: write it again"))]
    Broken { path: PathBuf, why: String },
    #[error("{}: has no channels R, G and B, and no Y; its channels are: {channels}", path.display())]
    #[diagnostic(help("write the picture as RGB"))]
    Channels { path: PathBuf, channels: String },
    #[error("{}: its channels are subsampled", .0.display())]
    #[diagnostic(help("write it with as many samples in each channel as there are pixels"))]
    Subsampled(PathBuf),
    #[error("{}: {}x{} is too large", path.display(), size.x, size.y)]
    #[diagnostic(help("a side is at most {} pixels", Film::MAX_SIDE))]
    TooLarge { path: PathBuf, size: UVec2 },
}

/// A picture whose pixels have not been read.
#[derive(Debug)]
pub struct Source {
    pub path: PathBuf,
    /// Pixels that the file has.
    pub size: UVec2,
    /// The first of them within the whole picture; `None` where the file doesn't say.
    pub place: Option<IVec2>,
    /// What is worth knowing about how it is read.
    pub notes: Vec<String>,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Exr(ExrFile),
    Raster(Format),
}

/// What the image crate decodes.
#[derive(Clone, Copy, Debug)]
enum Format {
    Png,
    Hdr,
}

impl Source {
    /// Reads the header. What the file is, its first bytes say, not its name.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let mut start = [0; 16];
        let length = open(path)?.take(16).read(&mut start).map_err(|source| unopened(path, source))?;
        let start = &start[..length];
        let source = if start.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
            let file = ExrFile::open(path)?;
            let (size, place, notes) = (file.size, Some(file.place), file.notes.clone());
            Self { path: path.to_path_buf(), size, place, notes, kind: Kind::Exr(file) }
        } else {
            let format = match start {
                _ if start.starts_with(b"\x89PNG\r\n\x1a\n") => Format::Png,
                _ if start.starts_with(b"#?RADIANCE") || start.starts_with(b"#?RGBE") => Format::Hdr,
                _ => return Err(ReadError::Unknown(path.to_path_buf())),
            };
            let (x, y) = decoder(path, format)?.dimensions();
            let kind = Kind::Raster(format);
            Self { path: path.to_path_buf(), size: UVec2::new(x, y), place: None, notes: Vec::new(), kind }
        };
        match source.size.max_element() > Film::MAX_SIDE || source.size.min_element() == 0 {
            true => Err(ReadError::TooLarge { path: source.path, size: source.size }),
            false => Ok(source),
        }
    }

    /// The pixels of a window of the file, row by row from the top.
    pub fn read(&mut self, window: Crop) -> Result<Vec<Pixel>, ReadError> {
        assert!(window.max.cmple(self.size).all(), "invariant: a window within the file");
        match &self.kind {
            Kind::Exr(file) => file.read(&self.path, window),
            Kind::Raster(format) => {
                let decoder = decoder(&self.path, *format)?;
                let image = DynamicImage::from_decoder(decoder).map_err(|error| broken(&self.path, error))?;
                self.notes.extend(notes(image.color()));
                Ok(pixels(&image, window))
            }
        }
    }
}

fn open(path: &Path) -> Result<File, ReadError> {
    files::open_regular(path).map_err(|source| unopened(path, source))
}

fn unopened(path: &Path, source: std::io::Error) -> ReadError {
    ReadError::Open { path: path.to_path_buf(), source }
}

/// The message of a decoder.
pub fn broken(path: &Path, error: impl std::fmt::Display) -> ReadError {
    ReadError::Broken { path: path.to_path_buf(), why: error.to_string() }
}

/// Reads the header. The size is for the caller to limit.
fn decoder(path: &Path, format: Format) -> Result<Box<dyn ImageDecoder>, ReadError> {
    let file = BufReader::new(open(path)?);
    let decoder: Result<Box<dyn ImageDecoder>, _> = match format {
        Format::Png => PngDecoder::with_limits(file, Limits::no_limits()).map(|decoder| Box::new(decoder) as _),
        // The strict decoder knows but one of the two signatures.
        Format::Hdr => HdrDecoder::new_nonstrict(file).map(|decoder| Box::new(decoder) as _),
    };
    decoder.map_err(|error| broken(path, error))
}

fn notes(colour: ColorType) -> Vec<String> {
    let mut notes = Vec::new();
    if colour.has_alpha() {
        notes.push("alpha is ignored".to_owned());
    }
    if matches!(colour, ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        notes.push("8-bit sRGB, rounded and clipped at 1: z sees that too".to_owned());
    }
    notes
}

/// Integers are sRGB (IEC 61966-2-1), floats linear.
fn pixels(image: &DynamicImage, window: Crop) -> Vec<Pixel> {
    let table = |most: u32| -> Vec<f32> {
        (0..=most).map(|code| srgb_decode(f64::from(code) / f64::from(most)) as f32).collect()
    };
    match image {
        DynamicImage::ImageLuma8(image) => picked(image, window, &table(255)),
        DynamicImage::ImageLumaA8(image) => picked(image, window, &table(255)),
        DynamicImage::ImageRgb8(image) => picked(image, window, &table(255)),
        DynamicImage::ImageRgba8(image) => picked(image, window, &table(255)),
        DynamicImage::ImageLuma16(image) => picked(image, window, &table(65535)),
        DynamicImage::ImageLumaA16(image) => picked(image, window, &table(65535)),
        DynamicImage::ImageRgb16(image) => picked(image, window, &table(65535)),
        DynamicImage::ImageRgba16(image) => picked(image, window, &table(65535)),
        linear => {
            let linear = linear.to_rgb32f();
            placed(window).map(|(x, y)| linear.get_pixel(x, y).0).collect()
        }
    }
}

fn placed(window: Crop) -> impl Iterator<Item = (u32, u32)> {
    (window.min.y..window.max.y).flat_map(move |y| (window.min.x..window.max.x).map(move |x| (x, y)))
}

/// The colours of integer pixels by a table of all codes; grey is all three.
fn picked<P>(image: &image::ImageBuffer<P, Vec<P::Subpixel>>, window: Crop, table: &[f32]) -> Vec<Pixel>
where
    P: image::Pixel,
    P::Subpixel: Into<u32>,
{
    let linear = |code: P::Subpixel| table[code.into() as usize];
    let pixel = |(x, y)| match *image.get_pixel(x, y).channels() {
        [grey] | [grey, _] => [linear(grey); 3],
        [r, g, b, ..] => [r, g, b].map(linear),
        [] => [0.0; 3],
    };
    placed(window).map(pixel).collect()
}
