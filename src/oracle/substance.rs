//! Materials with their maps: what a surface is at a point.

use std::collections::HashMap;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3, Vec3};

use super::bsdf::Bsdf;
use super::random::Random;
use super::texture::Map;
use crate::components::{DiffuseMap, Energy, Lobe, Maps, Material, Passage, Render, Texture};

/// A material as the oracle sees it.
pub struct Substance {
    material: Material,
    energy: Energy,
    /// Where no map changes it.
    bsdf: Bsdf,
    diffuse: Option<Arc<Map>>,
    specular: Option<Arc<Map>>,
    lobe: Option<Arc<Map>>,
    metallic: Option<Arc<Map>>,
    emission: Option<Arc<Map>>,
    opacity: Option<Arc<Map>>,
    relief: Option<Arc<Map>>,
    /// Part of the surface that is there where the map of opacity is 1.
    coverage: f64,
}

/// The textures of a world, each read once.
pub struct Textures<'w> {
    world: &'w World,
    read: HashMap<Entity, Arc<Map>>,
}

impl<'w> Textures<'w> {
    pub fn new(world: &'w World) -> Self {
        Self { world, read: HashMap::new() }
    }

    /// None where the entity is no texture.
    fn map(&mut self, entity: Option<Entity>) -> Option<Arc<Map>> {
        let entity = entity?;
        if let Some(map) = self.read.get(&entity) {
            return Some(map.clone());
        }
        let map = Arc::new(Map::new(self.world.get::<Texture>(entity)?));
        self.read.insert(entity, map.clone());
        Some(map)
    }
}

impl Substance {
    pub fn new(material: &Material, maps: &Maps, textures: &mut Textures, render: &Render) -> Self {
        let opacity = textures.map(maps.opacity);
        let diffuse = textures.map(maps.diffuse);
        let (mut material, mut coverage) = (*material, 1.0);
        if let (Passage::SeeThrough(there), Some(_)) = (material.passage, &opacity) {
            coverage = there.into();
            material.passage = Passage::Opaque;
        }
        if diffuse.is_some() && render.diffuse_map == DiffuseMap::Replace {
            material.diffuse = Vec3::ONE;
        }
        Self {
            material,
            energy: render.energy,
            bsdf: Bsdf::new(&material, render.energy),
            diffuse,
            specular: textures.map(maps.specular),
            lobe: textures.map(maps.lobe),
            metallic: textures.map(maps.metallic),
            emission: textures.map(maps.emission),
            opacity,
            relief: textures.map(maps.relief),
            coverage,
        }
    }

    /// The BSDF at a point, of one texel of each map: none of its numbers need be in proportion to what is reflected.
    pub fn bsdf(&self, uv: DVec2, random: &mut Random) -> Bsdf {
        let maps = [&self.diffuse, &self.specular, &self.lobe, &self.metallic];
        let [diffuse, specular, lobe, metallic] = maps.map(|map| map.as_ref().map(|map| map.drawn(uv, random)));
        if [diffuse, specular, lobe, metallic] == [None; 4] {
            return self.bsdf.clone();
        }
        let times = |number: f32, by: Option<DVec3>| (f64::from(number) * by.map_or(1.0, |by| by.x)) as f32;
        let mut material = self.material;
        material.diffuse = (material.diffuse.as_dvec3() * diffuse.unwrap_or(DVec3::ONE)).as_vec3();
        material.specular = (material.specular.as_dvec3() * specular.unwrap_or(DVec3::ONE)).as_vec3();
        material.metallic = times(material.metallic, metallic).min(1.0);
        material.lobe = match material.lobe {
            Lobe::Phong(exponent) => Lobe::Phong(times(exponent, lobe)),
            Lobe::Ggx(roughness) => Lobe::Ggx(times(roughness, lobe).min(1.0)),
            Lobe::Mirror => Lobe::Mirror,
        };
        self.bsdf.under(&material, self.energy)
    }

    /// Radiance at a point, from a side that emits.
    pub fn emission(&self, uv: DVec2) -> DVec3 {
        self.material.emission.as_dvec3() * self.emission.as_ref().map_or(DVec3::ONE, |map| map.filtered(uv))
    }

    /// What no point emits more of.
    pub fn brightest(&self) -> DVec3 {
        self.material.emission.as_dvec3() * self.emission.as_ref().map_or(DVec3::ONE, |map| map.most())
    }

    pub fn one_sided(&self) -> bool {
        self.material.one_sided
    }

    /// Whether a ray meets a point at all.
    pub fn is_there(&self, uv: DVec2, random: &mut Random) -> bool {
        let Some(opacity) = &self.opacity else { return true };
        random.unit() < self.coverage * opacity.filtered(uv).x
    }

    /// Whether it is not there somewhere.
    pub fn has_holes(&self) -> bool {
        self.opacity.is_some()
    }

    /// Whether no map changes what it does with light.
    pub fn is_the_same_everywhere(&self) -> bool {
        [&self.diffuse, &self.specular, &self.lobe, &self.metallic, &self.relief].into_iter().all(Option::is_none)
    }

    pub fn has_relief(&self) -> bool {
        self.relief.is_some()
    }

    /// The normal of a point in tangent space, of unit length; none where there is no map of it.
    pub fn relief(&self, uv: DVec2, random: &mut Random) -> Option<DVec3> {
        Some(self.relief.as_ref()?.drawn(uv, random).normalize())
    }
}
