//! What members have in common, and the order that makes the most of it.

use std::collections::HashMap;
use std::sync::Arc;

use crate::components::{Environment, Film, Render, Tone};
use crate::scene::SceneDescription;

/// What a member needs, each kind by a number that equal ones share; what is dearest to exchange comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Keys {
    /// Meshes, where they are, and which materials they have: the tree.
    pub geometry: usize,
    /// Shaders.
    pub code: usize,
    pub textures: usize,
    pub sky: usize,
    /// What picks the code of a kernel, or how materials are read.
    pub settings: usize,
    /// Lights without extent.
    pub lights: usize,
    pub materials: usize,
    /// Of shaders' parameters.
    pub values: usize,
    /// Camera, and the film but how it is shown.
    pub view: usize,
    /// Samples a pixel: a film goes on with more.
    pub spp: u32,
    /// Exposures and tone curves alone need no other film.
    pub exposure: usize,
}

impl Keys {
    /// Whether both are pictures of one film, of as many samples or not.
    pub fn shares_film(&self, other: &Self) -> bool {
        let film = |keys: &Self| Self { spp: 0, exposure: 0, ..*keys };
        film(self) == film(other)
    }
}

/// Numbers what it is shown, in the order of the first time. All descriptions are to live while it is asked: shared data are told apart by
/// where they are.
#[derive(Default)]
pub struct Numbering {
    seen: HashMap<(&'static str, String), usize>,
}

impl Numbering {
    /// Of a scene, drawn with the shaders of a number.
    pub fn keys(&mut self, scene: &SceneDescription, code: usize) -> Keys {
        let meshes = scene
            .meshes
            .iter()
            .map(|(name, mesh)| (name, Arc::as_ptr(&mesh.geometry), format!("{:?}", mesh.transform), &mesh.material));
        let geometry = format!("{:?}", meshes.collect::<Vec<_>>());
        let textures = scene.textures.iter().map(|(name, texture)| {
            let looks = (texture.reading, texture.wrap, texture.scale, texture.offset, texture.gain, texture.base);
            (name, Arc::as_ptr(&texture.image), looks)
        });
        let textures = format!("{:?}", textures.collect::<Vec<_>>());
        let sky = match &scene.environment {
            Some(Environment::Map { image, strength, tint, turn }) => {
                format!("{:?}", (Arc::as_ptr(image), strength, tint, turn))
            }
            other => format!("{other:?}"),
        };
        let Render {
            integrator,
            sampler,
            roulette,
            reuse,
            adaptive,
            energy,
            texture_filter,
            diffuse_map,
            texture_size,
            ..
        } = scene.render;
        let settings =
            (integrator, sampler, roulette, reuse, adaptive, energy, texture_filter, diffuse_map, texture_size);
        let film = Film { exposure: 0.0, tone: Tone::None, ..scene.film };
        let view = (scene.cameras.get(&scene.active), film, scene.render.max_depth, scene.render.seed);
        Keys {
            geometry: self.number("geometry", geometry),
            code,
            textures: self.number("textures", textures),
            sky: self.number("sky", sky),
            settings: self.number("settings", format!("{settings:?}")),
            lights: self.number("lights", format!("{:?}", scene.lights)),
            materials: self.number("materials", format!("{:?}", scene.materials)),
            values: self.number("values", format!("{:?}", scene.shader)),
            view: self.number("view", format!("{view:?}")),
            spp: scene.render.spp,
            exposure: self.number("exposure", format!("{:?}", (scene.film.exposure, scene.film.tone))),
        }
    }

    fn number(&mut self, kind: &'static str, text: String) -> usize {
        let next = self.seen.len();
        *self.seen.entry((kind, text)).or_insert(next)
    }
}
