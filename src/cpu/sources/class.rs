//! The ways that light comes to a pixel, by which its error is told apart.

use crate::layout::sources::{Contribution, LIGHT_POINT, LIGHT_SKY, LIGHT_SUN, WAY_FOUND, WAY_SAMPLED, WAY_SEEN};
use crate::layout::trace::NO_MATERIAL;

/// How the last choice of a direction came to be right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// There was none: the camera sees the light, straight or by mirrors and glass.
    Seen,
    /// The light was sampled.
    Sampled,
    /// The BSDF drew a direction that met the light.
    Found,
    /// Gathered from the paths of other pixels, and of this one, where paths are reused.
    Reused,
}

/// What sent the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Light {
    /// A mesh, by the order of their triangles.
    Mesh(u32),
    /// A row of the table of lights.
    Point(u32),
    Sun,
    /// Whatever else is around the scene.
    Sky,
    /// Not known: what is gathered is of many lights.
    Many,
}

/// A way that light comes, as far as ways are told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Class {
    /// Surfaces that sent the light on, without those that it went straight through; of what is gathered, the least that there may be.
    pub bounce: u32,
    pub way: Way,
    /// Index of the material where the last direction was chosen; none where that was the camera, or where it is not known.
    pub surface: Option<u32>,
    /// Of the mirror or glass that passed the light on to there, the one next to the light.
    pub through: Option<u32>,
    pub light: Light,
}

/// Which mesh a triangle is of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Emitters {
    /// The first triangle of each mesh, in scene order.
    firsts: Vec<u32>,
}

impl Emitters {
    /// Meshes by the index of their first triangle, in scene order.
    pub fn new(firsts: Vec<u32>) -> Self {
        Self { firsts }
    }

    /// The mesh of a triangle: of those that begin there, the last one, for others are empty.
    pub fn mesh_of(&self, triangle: u32) -> u32 {
        self.firsts.partition_point(|first| *first <= triangle).saturating_sub(1) as u32
    }
}

impl Class {
    /// What a path gathers of its tile.
    pub const GATHERED: Self = Self { bounce: 2, way: Way::Reused, surface: None, through: None, light: Light::Many };

    /// The way of a contribution.
    pub fn of(brought: &Contribution, emitters: &Emitters) -> Self {
        let material = |index: u32| (index != NO_MATERIAL).then_some(index);
        Self {
            bounce: brought.bounce,
            way: match brought.way {
                WAY_SEEN => Way::Seen,
                WAY_SAMPLED => Way::Sampled,
                WAY_FOUND => Way::Found,
                _ => Way::Reused,
            },
            surface: material(brought.surface),
            through: material(brought.through),
            light: match brought.light {
                LIGHT_SKY => Light::Sky,
                LIGHT_SUN => Light::Sun,
                light if light >= LIGHT_POINT => Light::Point(light - LIGHT_POINT),
                triangle => Light::Mesh(emitters.mesh_of(triangle)),
            },
        }
    }
}
