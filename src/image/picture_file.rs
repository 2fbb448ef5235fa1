//! The one reader of pictures: EXR, PNG and Radiance HDR as linear pixels. The size is known before a pixel is read.

use std::io::Read;
use std::path::{Path, PathBuf};

use glam::{I64Vec2, IVec2, UVec2};

use super::error::{Fault, ReadError};
use super::exr::{self, ExrFile};
use super::hdr::{self, HdrFile};
use super::pixel::Pixel;
use super::png;
use super::tail::Tail;
use crate::components::{Crop, Film};

/// Bytes from the start of a file that tell what it is.
const START: u64 = 4096;

/// What is read.
const KINDS: &str = "EXR, Radiance HDR and PNG";

/// A picture whose pixels have not been read: those that the file has, which need not be all that is to be shown.
#[derive(Debug)]
pub struct PictureFile {
    pub path: PathBuf,
    /// Pixels that the file has.
    pub size: UVec2,
    /// The first of them within the whole picture; `None` where the file doesn't say.
    pub place: Option<IVec2>,
    /// What is left out in reading it.
    pub notes: Vec<String>,
    /// What may not be as it was meant.
    pub warnings: Vec<String>,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Exr(Box<ExrFile>),
    Hdr(HdrFile),
    Png,
}

/// A picture as it is to be shown: black where the file has no pixels, without those that are beyond.
#[derive(Debug)]
pub struct Shown {
    pub size: UVec2,
    /// Row by row from the top.
    pub pixels: Vec<Pixel>,
    /// What is left out in reading it.
    pub notes: Vec<String>,
    /// What may not be as it was meant.
    pub warnings: Vec<String>,
}

impl PictureFile {
    /// Reads the header. What the file is, its first bytes say, not its name.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let source = named(path, Self::header(path))?;
        named(path, check_size(source.size))?;
        Ok(source)
    }

    /// The same of a file of any size.
    pub(super) fn header(path: &Path) -> Result<Self, Fault> {
        let mut start = Vec::new();
        let mut file = Tail::open(path)?;
        file.by_ref().take(START).read_to_end(&mut start).map_err(Fault::Open)?;
        let path = path.to_path_buf();
        if start.starts_with(&exr::MAGIC) {
            let mut file = ExrFile::open(&path)?;
            let (size, place) = (file.size, Some(file.place));
            let (notes, warnings) = (std::mem::take(&mut file.notes), std::mem::take(&mut file.warnings));
            return Ok(Self { path, size, place, notes, warnings, kind: Kind::Exr(Box::new(file)) });
        }
        if start.starts_with(&png::MAGIC) {
            let header = png::read_header(&path)?;
            let (size, notes, warnings) = (header.size, header.notes, header.warnings);
            return Ok(Self { path, size, place: None, notes, warnings, kind: Kind::Png });
        }
        if hdr::is_hdr(&start) {
            let mut file = HdrFile::open(&path)?;
            let (size, warnings) = (file.size, std::mem::take(&mut file.warnings));
            return Ok(Self { path, size, place: None, notes: Vec::new(), warnings, kind: Kind::Hdr(file) });
        }
        let begins = |magic: &[u8]| magic.starts_with(&start);
        Err(match start.is_empty() {
            true => Fault::Empty,
            false if begins(&exr::MAGIC) || begins(&png::MAGIC) || begins(hdr::MAGIC) => Fault::CutShort,
            false => Fault::Unknown { kinds: KINDS, text: std::str::from_utf8(&start).is_ok() },
        })
    }

    /// All pixels of the file, row by row from the top.
    pub fn read_all(&self) -> Result<Vec<Pixel>, ReadError> {
        self.read(Crop { min: UVec2::ZERO, max: self.size })
    }

    /// The exposure, stops, that it is to be shown at, where it says so: a PNG is shown as it is.
    pub fn exposure(&self) -> Option<f32> {
        match &self.kind {
            Kind::Exr(file) => file.exposure(),
            Kind::Hdr(_) | Kind::Png => None,
        }
    }

    /// Whether pixels have an alpha that is read.
    pub fn has_alpha(&self) -> bool {
        match &self.kind {
            Kind::Exr(file) => file.has_alpha(),
            Kind::Hdr(_) | Kind::Png => false,
        }
    }

    /// All pixels and their alpha, as it is stored: 1 where there is [none](Self::has_alpha).
    pub fn read_with_alpha(&self) -> Result<Vec<[f32; 4]>, ReadError> {
        match &self.kind {
            Kind::Exr(file) if self.size.min_element() > 0 => {
                named(&self.path, file.read_with_alpha(&self.path, Crop { min: UVec2::ZERO, max: self.size }))
            }
            Kind::Exr(_) | Kind::Hdr(_) | Kind::Png => {
                Ok(self.read_all()?.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect())
            }
        }
    }

    /// The pixels of a window of the file, row by row from the top. Memory is for the window, and for what one format or the
    /// other has to be decoded whole.
    pub fn read(&self, window: Crop) -> Result<Vec<Pixel>, ReadError> {
        assert!(window.max.cmple(self.size).all(), "invariant: a window within the file");
        if window.min.cmpge(window.max).any() {
            return Ok(Vec::new());
        }
        let pixels = match &self.kind {
            Kind::Exr(file) => file.read(&self.path, window),
            Kind::Hdr(file) => file.read(&self.path, window),
            Kind::Png => png::read(&self.path, window),
        };
        named(&self.path, pixels)
    }

    /// The size of what is to be shown, and where in it the file's first pixel is.
    fn shown(&self) -> (UVec2, IVec2) {
        match &self.kind {
            Kind::Exr(file) => (file.shown, file.place),
            Kind::Hdr(_) | Kind::Png => (self.size, IVec2::ZERO),
        }
    }
}

impl Shown {
    /// Reads a picture with all that belongs to it.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let mut source = named(path, PictureFile::header(path))?;
        let (size, place) = source.shown();
        named(path, check_size(size))?;
        let (place, end) = (place.as_i64vec2(), place.as_i64vec2() + source.size.as_i64vec2());
        let (min, max) = (place.max(I64Vec2::ZERO), end.min(size.as_i64vec2()));
        let apart = max.cmple(min).any();
        source.warnings.extend(beyond(&source, size, place, apart));
        let pixels = if apart {
            vec![[0.0; 3]; size.x as usize * size.y as usize]
        } else {
            let window = Crop { min: (min - place).as_uvec2(), max: (max - place).as_uvec2() };
            placed(source.read(window)?, window.size(), min.as_uvec2(), size)
        };
        Ok(Self { size, pixels, notes: source.notes, warnings: source.warnings })
    }
}

/// What is told of a file that has other pixels than are shown.
fn beyond(source: &PictureFile, size: UVec2, place: I64Vec2, apart: bool) -> Option<String> {
    let (width, height) = (source.size.x, source.size.y);
    let has =
        format!("it has {width}x{height} pixels from {},{} of a picture of {}x{}", place.x, place.y, size.x, size.y);
    let end = place + source.size.as_i64vec2();
    let (outside, part) = (
        place.min_element() < 0 || end.cmpgt(size.as_i64vec2()).any(),
        place.max_element() > 0 || end.cmplt(size.as_i64vec2()).any(),
    );
    match (apart, outside, part) {
        (true, ..) => Some(format!("{has}: none of them is in it, and all is black")),
        (false, true, true) => Some(format!("{has}: what is beyond is left out, and the rest is black")),
        (false, true, false) => Some(format!("{has}: what is beyond is left out")),
        (false, false, true) => Some(format!("{has}: the rest is black")),
        (false, false, false) => None,
    }
}

/// A picture of another one at a place, black around it.
fn placed(pixels: Vec<Pixel>, window: UVec2, place: UVec2, size: UVec2) -> Vec<Pixel> {
    if window == size {
        return pixels;
    }
    let mut whole = vec![[0.0; 3]; size.x as usize * size.y as usize];
    for (y, row) in pixels.chunks_exact(window.x as usize).enumerate() {
        let first = (place.y as usize + y) * size.x as usize + place.x as usize;
        whole[first..first + row.len()].copy_from_slice(row);
    }
    whole
}

fn check_size(size: UVec2) -> Result<(), Fault> {
    match size.min_element() >= 1 && size.max_element() <= Film::MAX_SIDE {
        true => Ok(()),
        false => Err(Fault::TooLarge { size, most: Film::MAX_SIDE }),
    }
}

fn named<T>(path: &Path, result: Result<T, Fault>) -> Result<T, ReadError> {
    result.map_err(|fault| ReadError { path: path.to_path_buf(), fault })
}
