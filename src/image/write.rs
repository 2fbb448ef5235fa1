//! Writes a finished film as PNG, EXR or JSON.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use glam::UVec2;

use super::file::{self, SaveError};
use super::source::{Frame, Metadata, Source, Strip, Told};
use super::write_exr::write_exr;
use super::write_png::write_png;
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
    pub metadata: &'a Metadata,
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
        match self.kind {
            Kind::Png | Kind::Exr => self.write_rows(&picture.frame(), &mut Whole::of(picture)),
            Kind::Json => self.write_report(picture.report),
        }
    }

    /// Writes a picture whose rows come one after the other; of a JSON output, nothing.
    pub fn write_rows(&self, frame: &Frame, source: &mut dyn Source) -> Result<(), SaveError> {
        match self.kind {
            Kind::Png => self.write_by(|out| write_png(frame, source, out)),
            Kind::Exr => self.write_by(|out| write_exr(frame, source, out)),
            Kind::Json => Ok(()),
        }
    }

    /// Writes the report alone.
    pub fn write_report(&self, report: &serde_json::Value) -> Result<(), SaveError> {
        self.write_by(|out| {
            serde_json::to_writer_pretty(&mut *out, report)?;
            out.write_all(b"\n")
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

impl Picture<'_> {
    pub fn frame(&self) -> Frame {
        Frame { size: self.size, window: self.window }
    }
}

/// A picture that is there as a whole.
struct Whole<'a> {
    strip: Option<Strip<'a>>,
    metadata: &'a Metadata,
}

impl<'a> Whole<'a> {
    fn of(picture: &Picture<'a>) -> Self {
        let Picture { linear, display, metadata, .. } = *picture;
        Self { strip: Some(Strip { linear, display }), metadata }
    }
}

impl Source for Whole<'_> {
    fn strip(&mut self) -> std::io::Result<Option<Strip<'_>>> {
        Ok(self.strip.take())
    }

    fn metadata(&self) -> Told<'_> {
        Told::Now(self.metadata)
    }
}
