//! A member's picture, made small.

use std::path::{Path, PathBuf};

use glam::UVec2;

use crate::app::shared::shrink::{fitting, shrink};
use crate::image::{PictureFile, ReadError};

/// Where a member's picture is.
pub fn picture_of(folder: &Path, member: &str) -> PathBuf {
    folder.join("members").join(format!("{member}.png"))
}

/// A small picture, sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thumb {
    pub size: UVec2,
    /// Row by row from the top.
    pub pixels: Vec<[u8; 3]>,
}

impl Thumb {
    /// Reads a picture and makes it small enough that no side is longer than `side`. A smaller one stays as it is.
    pub fn read(path: &Path, side: u32) -> Result<Self, ReadError> {
        let file = PictureFile::open(path)?;
        let size = fitting(file.size, side);
        let pixels = file.read_all()?;
        Ok(Self { size, pixels: shrink(file.size, size, |index| pixels[index].map(f64::from)) })
    }
}
