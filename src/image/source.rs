//! Where the pixels of a picture come from: rows from the top, as many at once as there are. So a file is written of more than memory holds.

use std::io;

use glam::UVec2;

use crate::components::Crop;

/// What is known of a picture before its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The whole picture, pixels.
    pub size: UVec2,
    /// The rendered rectangle within it.
    pub window: Crop,
}

/// Whole rows of a picture's window.
#[derive(Clone, Copy, Debug)]
pub struct Strip<'a> {
    /// Linear Rec.709 radiance, row by row.
    pub linear: &'a [[f32; 3]],
    /// The same as it is shown: sRGB, 8 bits, the fourth is ignored.
    pub display: &'a [[u8; 4]],
}

/// What is needed to repeat a render, as keys and values.
pub type Metadata = [(&'static str, String)];

/// When that is known.
#[derive(Clone, Copy, Debug)]
pub enum Told<'a> {
    Now(&'a Metadata),
    /// Behind the last row: as JSON, it takes so many bytes at most.
    AtTheEnd(usize),
}

/// Gives the pixels of a picture.
pub trait Source {
    /// The rows below those that were given before; none where there are no more, which may be before the window is full: what is left
    /// of it is black.
    fn strip(&mut self) -> io::Result<Option<Strip<'_>>>;

    /// What is needed to repeat the render: known behind the last row, if not before.
    fn metadata(&self) -> Told<'_>;
}
