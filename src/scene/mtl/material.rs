//! Materials by the numbers of the MTL format, and what they make of a surface: the one place where `illum` decides.
//!
//! `illum` says how a program was to draw, and many write one number on everything: alone it makes no glass. What else a
//! material says decides.
//!
//! | `illum` | and | is |
//! |---|---|---|
//! | 4, 6, 7, 9 | `Ni` other than 1, or a `Tf` that is neither 1 1 1 nor 0 0 0 | glass; a pane where a scene file says `thin` |
//! | any other, or without that | `d` below 1 | see-through |
//! | any other, or without that | `d` 1 | opaque |

use bevy_ecs::prelude::*;
use glam::Vec3;

use super::texture_map::TextureMaps;
use crate::components::{Lobe, Material, Passage};

/// A material as files have it and people edit it: the numbers of the table of keys. It is kept beside the [`Material`] that it comes
/// to, so that a number can be changed without losing what the others said. What is rendered is the [`Material`]: where
/// the two disagree, this one is an older memory.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct MtlMaterial {
    pub kd: Vec3,
    pub ks: Vec3,
    pub ns: f32,
    /// The specular lobe is GGX; without it, it is Phong's, or what `illum` says.
    pub pr: Option<f32>,
    pub pm: f32,
    /// Amount of the clear coat, and its roughness.
    pub pc: f32,
    pub pcr: f32,
    pub ke: Vec3,
    /// Off by default: winding in OBJ files is unreliable.
    pub one_sided: bool,
    pub ni: f32,
    /// Glass is a pane as one sheet.
    pub thin: bool,
    pub d: f32,
    pub tf: Vec3,
    /// 0 to 10.
    pub illum: u32,
    pub maps: TextureMaps,
}

/// `illum` of a plain surface, of a mirror, and of glass.
const PLAIN: u32 = 1;
const MIRROR: u32 = 3;
const GLASS: u32 = 4;

/// Indices within this of 1 bend nothing that could be seen.
const BENDS: f32 = 5e-4;

/// A filter within this of all or nothing says no more than they do.
const FILTERS: f32 = 5e-3;

impl Default for MtlMaterial {
    /// The grey of [`Material::default`].
    fn default() -> Self {
        Self::from(Material::default())
    }
}

impl MtlMaterial {
    /// What it makes of a surface.
    pub fn material(&self) -> Material {
        Material {
            diffuse: self.kd,
            specular: self.ks,
            lobe: self.lobe(),
            metallic: self.pm,
            coat: self.pc,
            coat_roughness: self.pcr,
            emission: self.ke,
            one_sided: self.one_sided,
            passage: self.passage(),
            filter: self.tf,
        }
    }

    /// How light gets through.
    pub fn passage(&self) -> Passage {
        if self.asks_for_glass() && (self.bends() || self.filters()) {
            if self.thin { Passage::Pane(self.ni) } else { Passage::Glass(self.ni) }
        } else if self.d < 1.0 {
            Passage::SeeThrough(self.d)
        } else {
            Passage::Opaque
        }
    }

    pub fn is_glass(&self) -> bool {
        matches!(self.passage(), Passage::Glass(_) | Passage::Pane(_))
    }

    /// The specular lobe, where `ks` or `pm` gives the surface one.
    pub fn lobe(&self) -> Lobe {
        match (self.pr, self.illum) {
            (Some(roughness), _) => Lobe::Ggx(roughness),
            (None, 3 | 5 | 8) => Lobe::Mirror,
            (None, _) => Lobe::Phong(self.ns),
        }
    }

    /// Whether `illum` is one of a transparent surface.
    pub fn asks_for_glass(&self) -> bool {
        matches!(self.illum, 4 | 6 | 7 | 9)
    }

    /// Whether `ni` is seen.
    pub(super) fn bends(&self) -> bool {
        (self.ni - 1.0).abs() > BENDS
    }

    /// Whether `tf` is seen, and lets anything through.
    pub(super) fn filters(&self) -> bool {
        self.tf.min_element() < 1.0 - FILTERS && self.tf.max_element() > FILTERS
    }
}

impl From<Material> for MtlMaterial {
    /// Numbers that come to this material. Glass that is not to be told from nothing comes to nothing: `d` 0.
    fn from(material: Material) -> Self {
        let Material { diffuse, specular, lobe, metallic, coat, coat_roughness, emission, one_sided, passage, filter } =
            material;
        let mut numbers = Self {
            kd: diffuse,
            ks: specular,
            ns: 1.0,
            pr: None,
            pm: metallic,
            pc: coat,
            pcr: coat_roughness,
            ke: emission,
            one_sided,
            ni: 1.0,
            thin: matches!(passage, Passage::Pane(_)),
            d: 1.0,
            tf: filter,
            illum: PLAIN,
            maps: TextureMaps::default(),
        };
        match lobe {
            Lobe::Phong(exponent) => numbers.ns = exponent,
            Lobe::Ggx(roughness) => numbers.pr = Some(roughness),
            Lobe::Mirror => numbers.illum = MIRROR,
        }
        match passage {
            Passage::Opaque => {}
            Passage::SeeThrough(opacity) => numbers.d = opacity,
            Passage::Glass(index) | Passage::Pane(index) => {
                let glass = Self { illum: GLASS, ni: index, ..numbers.clone() };
                numbers = if glass.is_glass() { glass } else { Self { d: 0.0, ..numbers } };
            }
        }
        numbers
    }
}
