//! What an MTL file or a scene file says of one texture: a file, and how it is looked up.

use std::path::PathBuf;

use glam::Vec2;

use crate::components::{Channel, Wrap};

/// A texture that a material names. The file need not be there, nor be a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureMap {
    /// Found, or where it was looked for.
    pub file: PathBuf,
    pub wrap: [Wrap; 2],
    /// Texture coordinates are looked up at `(u, v) * scale + offset`.
    pub scale: Vec2,
    pub offset: Vec2,
    /// `-mm BASE GAIN`.
    pub gain: f32,
    pub base: f32,
    /// `-imfchan`; none: alpha where that says something, else luminance.
    pub channel: Option<Channel>,
    /// `-bm`: how high white is above black, in hundredths of the picture's width.
    pub bump: f32,
    /// Of a picture of directions: green grows downwards.
    pub flip_green: bool,
    /// The number that it multiplies was not given, or as 0: it counts as 1 beside this map, and as its default without
    /// ([`MtlMaterial::settle`](super::MtlMaterial::settle)).
    pub alone: bool,
    /// Kept, but not rendered.
    pub off: bool,
}

/// The textures of a material, by the statement that names each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureMaps {
    pub kd: Option<TextureMap>,
    pub ks: Option<TextureMap>,
    pub ns: Option<TextureMap>,
    pub ke: Option<TextureMap>,
    pub d: Option<TextureMap>,
    pub pr: Option<TextureMap>,
    pub pm: Option<TextureMap>,
    /// `norm`: directions.
    pub norm: Option<TextureMap>,
    /// `map_Bump`, `bump` or `disp`: heights, or directions where the picture is one of them.
    pub bump: Option<TextureMap>,
}

impl TextureMap {
    /// A whole picture, as it is.
    pub fn new(file: impl Into<PathBuf>) -> Self {
        Self {
            file: file.into(),
            wrap: [Wrap::Repeat; 2],
            scale: Vec2::ONE,
            offset: Vec2::ZERO,
            gain: 1.0,
            base: 0.0,
            channel: None,
            bump: 1.0,
            flip_green: false,
            alone: false,
            off: false,
        }
    }
}
