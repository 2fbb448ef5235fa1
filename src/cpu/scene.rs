//! A scene as paths of the twin see it, and what their rays hit in it.

use glam::{DMat3, DVec3, UVec4};

use super::connect::LightSampler;
use super::pcg4d::pcg4d;
use super::rng::{Source, random_words, unit};
use super::sun::SunDisk;
use super::texture::TextureSet;
use super::triangles::{HitF64, TriangleSet};
use crate::layout::light::LightTable;
use crate::layout::sky::SkyTable;
use crate::layout::texture::{CUTOUT_DIMENSIONS, NO_CHANCE};
use crate::layout::trace::{MaterialRecord, SampleKey, Shading, TraceParams};
use crate::layout::tree::Triangle;

/// A scene as the trace kernel gets it.
pub struct PathScene<'a> {
    pub triangles: TriangleSet,
    pub materials: &'a [MaterialRecord],
    /// In scene order; empty: geometric normals everywhere.
    pub shading: &'a [Shading],
    /// Russian roulette.
    pub roulette: bool,
    /// Of random numbers.
    pub sampler: Source,
    /// The lights that are sampled: all with integrator `Path`, points alone with `Bsdf`.
    pub lights: Option<LightTable>,
    /// A picture of the sky, in place of the constant environment; sampled as the lights are.
    pub sky: Option<&'a SkyTable>,
    pub textures: TextureSet<'a>,
    /// Material of each triangle, in scene order: where lights have maps.
    pub materials_of: Vec<u32>,
    /// From directions of that picture to those of the scene: a rotation.
    pub sky_turn: DMat3,
}

impl<'a> PathScene<'a> {
    /// Without shading normals and without roulette.
    pub fn new(triangles: &[Triangle], materials: &'a [MaterialRecord]) -> Self {
        Self {
            triangles: TriangleSet::new(triangles),
            materials,
            shading: &[],
            roulette: false,
            sampler: Source::Pcg,
            lights: None,
            sky: None,
            textures: TextureSet::default(),
            materials_of: triangles.iter().map(|triangle| triangle.material).collect(),
            sky_turn: DMat3::IDENTITY,
        }
    }

    /// What a ray hits first, of what is there for it. Hits are within 1e-15 of the scene's size, so 1e-9 leaves out the surface the ray
    /// starts on, and it alone.
    pub(super) fn first_hit(
        &self,
        origin: DVec3,
        direction: DVec3,
        key: SampleKey,
        rays: &mut u32,
    ) -> Option<HitF64<'_>> {
        let chance = self.chance(key, *rays);
        *rays += 1;
        self.closest_there(origin, direction, chance)
    }

    /// The number by which surfaces with holes are there for a ray of a path, or not.
    pub(super) fn chance(&self, key: SampleKey, ray: u32) -> u32 {
        if self.textures.maps.is_empty() { NO_CHANCE } else { random_words(key, CUTOUT_DIMENSIONS + ray).x | 1 }
    }

    /// What a ray hits first, of what is there for such a number.
    pub(super) fn closest_there(&self, origin: DVec3, direction: DVec3, chance: u32) -> Option<HitF64<'_>> {
        let is_there = |hit: &HitF64| {
            let triangle = hit.triangle.index;
            let words = pcg4d(UVec4::new(chance, triangle, CUTOUT_STREAM, 0));
            self.textures.is_there(hit.triangle.material, triangle, hit.b, [unit(words.x), unit(words.y)])
        };
        match self.textures.maps.is_empty() {
            true => self.triangles.closest(origin, direction, 1e-9),
            false => self.triangles.closest_of(origin, direction, 1e-9, is_there),
        }
    }

    /// What light is sampled from, if from anything.
    pub(super) fn light_sampler(&self, params: &TraceParams) -> Option<LightSampler<'_>> {
        let lights = self.lights.as_ref()?;
        let sky = self.sky.filter(|sky| sky.power > 0.0 && params.sky_density > 0.0);
        let any = sky.is_some() || !lights.lights.is_empty();
        any.then(|| LightSampler {
            lights,
            sky,
            sky_turn: self.sky_turn,
            light_share: f64::from(params.light_share),
            light_density: f64::from(params.light_density),
            point_density: f64::from(params.point_density),
            sun: SunDisk::new(params),
            sun_end: f64::from(params.sun_end),
        })
    }
}

/// Sets the hashes that decide about holes off from those of other numbers.
const CUTOUT_STREAM: u32 = 0x6375_7400;
