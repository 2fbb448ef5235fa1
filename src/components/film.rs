//! The film, and how it is to be exposed.

use bevy_ecs::prelude::*;
use glam::UVec2;

/// The picture's size, the part of it that is rendered, and how it is shown.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Whole picture in pixels, each side 1 to [`Film::MAX_SIDE`].
    pub size: UVec2,
    /// The part that is rendered; `None` is all of it.
    pub crop: Option<Crop>,
    /// Stops: the picture is multiplied by 2^exposure before it is shown.
    pub exposure: f32,
    /// How what is brighter than white is shown.
    pub tone: Tone,
}

impl Film {
    /// Pixels a side, at most.
    pub const MAX_SIDE: u32 = 16_384;

    /// The rendered rectangle, whole where there is no crop.
    pub fn window(&self) -> Crop {
        self.crop.unwrap_or(Crop { min: UVec2::ZERO, max: self.size })
    }
}

impl Default for Film {
    fn default() -> Self {
        Self { size: UVec2::splat(512), crop: None, exposure: 0.0, tone: Tone::None }
    }
}

/// A curve from exposed light to what a display can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// What is brighter than white is white, channel by channel.
    #[default]
    None,
    /// AgX (Sobotka 2022): 16.5 stops, in which bright colours fade to white as on film.
    Agx,
    /// Khronos PBR Neutral (2024): colours are what they are up to 0.8, and bright ones are compressed.
    Neutral,
}

/// A rectangle of pixels: `min` inside, `max` just outside, origin at the top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    pub min: UVec2,
    pub max: UVec2,
}

impl Crop {
    /// Width and height in pixels.
    pub fn size(&self) -> UVec2 {
        self.max - self.min
    }
}

/// How light is estimated.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Render {
    pub integrator: Integrator,
    pub sampler: Sampler,
    /// Path segments: 1 sees emitters only. 1 to [`Render::MAX_DEPTH`].
    pub max_depth: u32,
    /// End paths of little throughput early, unbiased.
    pub roulette: bool,
    /// Of integrator `Path` alone.
    pub reuse: Reuse,
    pub adaptive: Adaptive,
    pub energy: Energy,
    pub texture_filter: TextureFilter,
    pub diffuse_map: DiffuseMap,
    /// Texels a side of a texture, at most: larger ones are halved until they fit. 1 to [`Render::MAX_TEXTURE`].
    pub texture_size: u32,
    /// Seed of every random number.
    pub seed: u32,
    /// Samples a pixel after which the film is finished, at least 1; of an adaptive film, on average.
    pub spp: u32,
}

impl Render {
    /// Segments of the longest path, at most.
    pub const MAX_DEPTH: u32 = 1024;

    /// Texels a side of the largest texture.
    pub const MAX_TEXTURE: u32 = 32_768;
}

impl Default for Render {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            sampler: Sampler::default(),
            max_depth: 16,
            roulette: true,
            reuse: Reuse::default(),
            adaptive: Adaptive::default(),
            energy: Energy::Preserve,
            texture_filter: TextureFilter::default(),
            diffuse_map: DiffuseMap::default(),
            texture_size: Self::MAX_TEXTURE,
            seed: 0,
            spp: 64,
        }
    }
}

/// The estimator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Directions from the BSDF alone; light is found by hitting it. Lights without extent, which nothing hits, are sampled.
    Bsdf,
    /// The same, and at every surface a light is asked directly; both ways are weighted together.
    #[default]
    Path,
}

/// Where the random numbers of a sample come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampler {
    /// Owen-scrambled Sobol points: the samples of a pixel are spread evenly over what they are drawn for.
    #[default]
    Sobol,
    /// Independent numbers by a hash: the reference.
    Pcg,
}

/// Whether pixels use each other's paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reuse {
    /// Each pixel has its own.
    #[default]
    Off,
    /// What the diffuse surface that a path comes to second sends on is gathered by the 16 pixels of a tile.
    Tiles,
}

/// Whether pixels get different numbers of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Adaptive {
    /// All get the same.
    #[default]
    Off,
    /// Tiles of 8 by 8 pixels get more where they are noisy.
    On,
}

/// What becomes of materials that reflect more than they receive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Energy {
    /// Kd and Ks are divided by max(1, the largest channel of Kd + Ks).
    #[default]
    Preserve,
    /// Kd and Ks as the file has them.
    AsWritten,
}

/// How much of a texture a lookup takes in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureFilter {
    /// What the path's cone covers of it, through all bounces.
    #[default]
    Footprint,
    /// A point: what the other is judged by.
    Exact,
}

/// What a map of the diffuse reflectance does with the material's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiffuseMap {
    /// It multiplies it.
    #[default]
    Multiply,
    /// It takes its place.
    Replace,
}
