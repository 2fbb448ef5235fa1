//! A picture that was read as a texture.

use crate::components::TextureImage;

/// A picture with its texels.
#[derive(Debug)]
pub struct ReadTexture {
    pub image: TextureImage,
    pub alpha: Alpha,
    /// Texels that had a channel which was negative, no number or above 65504: it is 0, or 65504.
    pub mended: u64,
    /// What may not be as it was meant.
    pub warnings: Vec<String>,
    /// The same where it is read for colours.
    pub colours: Vec<String>,
}

/// What a picture's alpha says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alpha {
    /// There is none.
    None,
    /// Everything is there.
    Opaque,
    /// Something is not.
    Partial,
}
