//! The scene as the GPU holds it: where each entity's data is, and what all of it comes to.

use std::collections::BTreeSet;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, UVec2, Vec3, Vec4};

use crate::components::{Daylight, DiffuseMap, Energy, EnvironmentMap, Integrator, MeshData, Transform};
use crate::cpu::film::Joined;
use crate::gpu::TableRow;
use crate::layout::cdf::CdfEntry;
use crate::layout::film::DisplayParams;
use crate::layout::light::LightRecord;
use crate::layout::texture::{CornerUvs, MaterialMaps, Tangents, TextureRecord};
use crate::layout::trace::{MaterialRecord, Shading, TraceParams};
use crate::layout::tree::Triangle;
use crate::passes::film::{Look, display_params};
use crate::passes::lattice::Lattice;

/// A pixel of the environment: radiance, linear Rec.709, and an unused word.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SkyCell(pub Vec4);

/// A word of the textures.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Texel(pub u32);

/// What a triangle sends out on average, luminance; 0 where light sampling does not know it.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MeanEmission(pub f32);

/// Each array of the scene: a row a type.
macro_rules! tables {
    ($($row:ty => $buffer:literal,)+) => { $(
        impl TableRow for $row {
            const BUFFER: &'static str = $buffer;
        }
    )+ };
}

tables! {
    Triangle => "triangles",
    Shading => "shading",
    MaterialRecord => "materials",
    LightRecord => "lights",
    SkyCell => "sky",
    CdfEntry => "sky_cdf",
    TextureRecord => "textures",
    Texel => "texels",
    MaterialMaps => "material_maps",
    CornerUvs => "uvs",
    Tangents => "tangents",
    MeanEmission => "mean_emission",
}

/// Everything is to be extracted again: a run of the schedule went wrong, and what it took note of may be lost.
#[derive(Resource, Default)]
pub struct Everything(pub bool);

/// What the settings say of materials and lights.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Policy {
    pub energy: Energy,
    pub integrator: Integrator,
    pub diffuse_map: DiffuseMap,
    /// Texels a side of a texture, at most.
    pub texture_size: u32,
}

/// Some material has a relief: the facets that its normals lean off are kept track of.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Relief(pub bool);

/// Index of a material's record: by the order of names. The record behind the last is the default one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaterialSlot(pub u32);

/// Where a mesh's triangles are in the table, and what they were made from: by comparing with these, an edit that
/// changes nothing does nothing.
#[derive(Component, Clone, Debug)]
pub struct MeshSlot {
    /// Index of its first triangle.
    pub first: u32,
    pub count: u32,
    /// World space corners, scene units; empty meshes have low above high.
    pub low: DVec3,
    pub high: DVec3,
    pub geometry: Arc<MeshData>,
    pub transform: Transform,
    pub material: u32,
}

impl MeshSlot {
    /// Whether both make the same triangles in the same place.
    pub fn same(&self, other: &MeshSlot) -> bool {
        let numbers = |slot: &MeshSlot| (slot.first, slot.count, slot.material, slot.transform);
        numbers(self) == numbers(other) && Arc::ptr_eq(&self.geometry, &other.geometry)
    }
}

/// What all meshes come to.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct SceneGeometry {
    /// Meshes in the order of their names: that of their triangles.
    pub meshes: Vec<Entity>,
    /// World space point that is zero on the GPU.
    pub origin: DVec3,
    /// World space box of all meshes, scene units; low above high without any.
    pub low: DVec3,
    pub high: DVec3,
    /// Some mesh has normals of its own, or some material bends them.
    pub normals: bool,
}

impl Default for SceneGeometry {
    fn default() -> Self {
        Self {
            meshes: Vec::new(),
            origin: DVec3::ZERO,
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
            normals: false,
        }
    }
}

/// What the environment's picture is made of.
#[derive(Clone, Debug)]
pub enum SkySource {
    /// A picture, and what it is multiplied by.
    Map(Arc<EnvironmentMap>, Vec3),
    /// A day, its sun's azimuth 0.
    Daylight(Daylight),
}

impl SkySource {
    /// Whether both make the same tables; pictures are compared by identity.
    pub fn same(&self, other: &SkySource) -> bool {
        match (self, other) {
            (Self::Map(a, by), Self::Map(b, other)) => {
                Arc::ptr_eq(a, b) && by.to_array().map(f32::to_bits) == other.to_array().map(f32::to_bits)
            }
            (Self::Daylight(a), Self::Daylight(b)) => a == b,
            _ => false,
        }
    }
}

/// What came of the environment's picture.
#[derive(Resource, Default, Clone, Debug)]
pub struct Sky {
    /// What the tables are of; none without a picture.
    pub source: Option<SkySource>,
    /// Pixels; zero without a picture.
    pub size: UVec2,
    /// How often the picture's sides were halved for want of room on the device.
    pub halvings: u32,
    /// Integral of the luminance over the sphere.
    pub power: f64,
    /// The largest channel of any pixel.
    pub brightest: f32,
}

/// 1 / the sum of the powers of all emitting triangles that are sampled; 0 without any.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq)]
pub struct LightDensity(pub f32);

/// What the camera, the film, the settings and the scene come to for the trace kernel: another one is another film.
#[derive(Resource, Default, Clone, Debug)]
pub struct Shot {
    /// Parameters of the kernel but for the batch.
    pub params: TraceParams,
    /// Radiance is summed in units of 2^-exponent.
    pub exponent: i32,
    /// Shader features that the scene needs.
    pub features: BTreeSet<String>,
}

impl Shot {
    /// Pixels of the window.
    pub fn size(&self) -> UVec2 {
        UVec2::new(self.params.window_width, self.params.window_height)
    }

    /// Whether paths are reused within tiles.
    pub fn reuses(&self) -> bool {
        self.features.contains("reuse")
    }

    /// Whether tiles get as many samples as they need.
    pub fn is_adaptive(&self) -> bool {
        self.features.contains("adaptive")
    }

    /// How the halves of a pixel become its mean.
    pub fn joined(&self) -> Joined {
        if self.is_adaptive() { Joined::ByHalves } else { Joined::BySamples }
    }

    /// Parameters of the display pass, where each pixel of `shown` stands for its block.
    pub fn display_params(&self, shown: Lattice, look: Look) -> DisplayParams {
        let params = display_params(self.size(), shown, self.exponent, look);
        DisplayParams { by_halves: u32::from(self.is_adaptive()), ..params }
    }

    /// Whether what is gathered has a material of its own at every point.
    pub fn is_textured(&self) -> bool {
        self.features.contains("textures")
    }

    /// Whether both make the same film. By bits: a NaN differs from itself, and would start the film anew for ever.
    pub fn same(&self, other: &Shot) -> bool {
        bytemuck::bytes_of(&self.params) == bytemuck::bytes_of(&other.params)
            && self.exponent == other.exponent
            && self.features == other.features
    }
}

/// How the film is shown.
#[derive(Resource, Default, Clone, Copy, Debug)]
pub struct Displayed(pub Look);

/// Films go on for as long as they are let, whatever their settings say.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Endless(pub bool);

/// The trace kernels are compiled with all that can be idle in them.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct General(pub bool);

/// Samples a pixel to reach.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target(pub u32);
