//! Textures: pictures that surfaces look up, and which of a material's numbers they are multiplied to.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec2};

/// A picture's texels, row by row from the top, as its file has them.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureImage {
    /// Texels, each side at least 1.
    pub size: UVec2,
    pub texels: Texels,
}

/// The texels of a picture, by what its file has: `size.x * size.y` of them.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Codes of red, green, blue and alpha, 0 to 255.
    Rgba8(Vec<[u8; 4]>),
    /// Codes of a grey picture without alpha.
    Grey8(Vec<u8>),
    /// Codes of a grey picture without alpha, 0 to 65535.
    Grey16(Vec<u16>),
    /// The same of red, green, blue and alpha.
    Rgba16(Vec<[u16; 4]>),
    /// Linear Rec.709 and alpha: finite, at least 0.
    Float(Vec<[f32; 4]>),
}

/// A texture: a picture, and how it is looked up.
///
/// A surface point of texture coordinates (u, v), v up, is at `(u, v) * scale + offset` in the picture, whose lower left corner is (0, 0)
/// and whose upper right is (1, 1). Texels are points at the middles of their cells, and what lies between is filtered linearly.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Texture {
    pub image: Arc<TextureImage>,
    pub reading: Reading,
    /// What continues the picture beyond its edges, along u and v.
    pub wrap: [Wrap; 2],
    pub scale: Vec2,
    pub offset: Vec2,
    /// A value is `base + gain` times what the picture has. Of directions and heights, neither counts.
    pub gain: f32,
    pub base: f32,
}

/// What a texel says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// A colour; codes are sRGB's.
    Colour,
    /// One number of 0 to 1; codes are proportional to it.
    Number(Channel),
    /// A direction in tangent space: 2 rgb - 1, the third of it away from the surface. Codes are proportional.
    Normal {
        /// Green grows downwards in the picture, as Direct3D has it.
        flip_green: bool,
    },
    /// The height of the surface. Codes are proportional.
    Height {
        channel: Channel,
        /// Height of white above black, in widths of the picture: texels are taken as squares.
        depth: f32,
    },
}

/// Which part of a texel is a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Channel {
    Red,
    Green,
    Blue,
    Alpha,
    /// Rec.709 luminance of the codes.
    Luminance,
}

/// What a texture has beyond its picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The texels of its edge.
    Clamp,
}

/// The textures of a material: entities with a [`Texture`]. Each multiplies a number of the [`Material`](super::Material); one that is
/// no texture counts as none.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Maps {
    /// Multiplies `diffuse`, or takes its place ([`DiffuseMap`](super::DiffuseMap)).
    pub diffuse: Option<Entity>,
    /// Multiplies `specular`.
    pub specular: Option<Entity>,
    /// Multiplies the exponent or the roughness of the lobe.
    pub lobe: Option<Entity>,
    /// Multiplies `metallic`.
    pub metallic: Option<Entity>,
    /// Multiplies `emission`.
    pub emission: Option<Entity>,
    /// What part of the surface is there, times the opacity of a see-through surface. Light passes through the rest as if
    /// there were nothing: shadow rays too.
    pub opacity: Option<Entity>,
    /// Directions or heights: they bend the shading normal.
    pub relief: Option<Entity>,
}

impl TextureImage {
    /// One grey texel of a code.
    pub fn grey(code: u8) -> Self {
        Self { size: UVec2::ONE, texels: Texels::Grey8(vec![code]) }
    }
}

impl Texture {
    /// A picture once in each unit of texture coordinates, as it is.
    pub fn new(image: Arc<TextureImage>, reading: Reading) -> Self {
        Self { image, reading, wrap: [Wrap::Repeat; 2], scale: Vec2::ONE, offset: Vec2::ZERO, gain: 1.0, base: 0.0 }
    }
}

impl Texture {
    /// Whether another texture is looked up in the same way, whatever its picture is.
    pub fn is_read_as(&self, other: &Self) -> bool {
        let looks = |t: &Self| (t.reading, t.wrap, t.scale, t.offset, t.gain, t.base);
        looks(self) == looks(other)
    }
}

impl Maps {
    /// Every texture there is.
    pub fn all(&self) -> impl Iterator<Item = Entity> {
        let Self { diffuse, specular, lobe, metallic, emission, opacity, relief } = *self;
        [diffuse, specular, lobe, metallic, emission, opacity, relief].into_iter().flatten()
    }
}
