//! A picture of textures in memory, and what is to be said of it.

use std::sync::Arc;

use glam::UVec2;

use crate::components::TextureImage;
use crate::image::{Alpha, Codes};

/// A picture, whatever it is looked up for.
#[derive(Clone, Debug)]
pub struct Picture {
    pub image: Arc<TextureImage>,
    pub facts: Facts,
}

/// What is known of a picture beside its texels.
#[derive(Clone, Debug)]
pub struct Facts {
    /// As the file has it.
    pub header: Header,
    pub reduction: Reduction,
    pub alpha: Alpha,
    /// Texels with a value that was none.
    pub mended: u64,
    pub warnings: Vec<String>,
    /// Those that matter for colours only.
    pub colours: Vec<String>,
}

/// What a file's header says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header {
    pub size: UVec2,
    /// Of all texels.
    pub bytes: u64,
}

/// How much smaller than its file a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reduction {
    /// How many times its sides are halved.
    pub halvings: u32,
    /// By what mean, where they are.
    pub codes: Codes,
}

impl Reduction {
    /// Whether a picture that was made by another is the same.
    pub fn is_like(self, other: Self) -> bool {
        self.halvings == other.halvings && (self.halvings == 0 || self.codes == other.codes)
    }
}
