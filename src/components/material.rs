//! Surface materials, by their lobes.

use bevy_ecs::prelude::*;
use glam::Vec3;

/// What a surface does with light. Linear Rec.709; every number finite.
///
/// An energy policy ([`Energy`](super::Energy)) bounds what both lobes reflect together.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Reflectance of the diffuse lobe, each channel at least 0.
    pub diffuse: Vec3,
    /// Reflectance of the specular lobe, each channel at least 0.
    pub specular: Vec3,
    /// Shape of the specular lobe.
    pub lobe: Lobe,
    /// 0 to 1: this part of `diffuse` is reflected by the specular lobe instead.
    pub metallic: f32,
    /// Part of the surface that has a clear coat over both lobes, 0 to 1; glass has none. What is emitted does not pass it.
    pub coat: f32,
    /// Roughness of the coat, 0 to 1: alpha is its square.
    pub coat_roughness: f32,
    /// Emitted radiance, each channel at least 0.
    pub emission: Vec3,
    /// Light leaves the front side only (counter-clockwise winding seen from there).
    pub one_sided: bool,
    pub passage: Passage,
    /// What light is multiplied by that gets through, at each crossing: each channel 0 to 1.
    pub filter: Vec3,
}

/// The shape of a specular lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// Of this exponent, 0 to 1e5.
    Phong(f32),
    /// Of this roughness, 0 to 1: alpha is its square.
    Ggx(f32),
    Mirror,
}

/// How light gets through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// Not at all.
    Opaque,
    /// Of this opacity, 0 to 1: the rest of the light goes straight on.
    SeeThrough(f32),
    /// Refracted by this index, at least 1, or reflected; the surface does nothing else.
    Glass(f32),
    /// A pane of this index, at least 1, as one sheet: both its faces at once, so that light goes straight on or is mirrored; alike from both
    /// sides, and nothing else. A crossing is that from face to face.
    Pane(f32),
}

/// A surface of which no more than this is there is not seen: it changes no picture of 8 bits.
const SEEN: f32 = 1e-3;

/// A filter within this of 1 takes nothing away that could be seen.
const CLEAR: f32 = 1.0 - 5e-3;

impl Material {
    /// Black and opaque.
    pub const BLACK: Self = Self {
        diffuse: Vec3::ZERO,
        specular: Vec3::ZERO,
        lobe: Lobe::Phong(0.0),
        metallic: 0.0,
        coat: 0.0,
        coat_roughness: 0.0,
        emission: Vec3::ZERO,
        one_sided: false,
        passage: Passage::Opaque,
        filter: Vec3::ONE,
    };

    /// Whether rays go through it as if it were not there.
    pub fn is_invisible(&self) -> bool {
        let gone = matches!(self.passage, Passage::SeeThrough(opacity) if opacity <= SEEN);
        gone && self.filter.min_element() >= CLEAR && self.emission == Vec3::ZERO
    }
}

impl Default for Material {
    /// A grey Lambert surface: what meshes get that name no material, or one that no library has.
    fn default() -> Self {
        Self { diffuse: Vec3::splat(0.6), lobe: Lobe::Phong(1.0), ..Self::BLACK }
    }
}
