//! What is rendered of a material's numbers and maps, by the textures that are there.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::mtl::{MtlMaterial, TextureMaps};
use super::textures::name;
use crate::components::{Lobe, Maps, Material};

impl MtlMaterial {
    /// What it comes to after an edit; `textures` are the scene's by their names. Numbers that a map says alone get their values by
    /// whether it is rendered.
    pub fn rendered(&mut self, textures: &BTreeMap<String, Entity>) -> (Material, Maps) {
        self.settle(|map, used| textures.contains_key(&name(map, used)));
        let material = self.material();
        (material, self.maps.maps(matches!(material.lobe, Lobe::Ggx(_)), textures))
    }
    /// These numbers, of a material that was edited by itself: maps that are not rendered any more are off.
    pub(super) fn as_rendered(&self, material: &Material, maps: &Maps, textures: &BTreeMap<String, Entity>) -> Self {
        let mut now = self.clone();
        if self.material() != *material {
            now = Self { maps: self.maps.clone(), ..Self::from(*material) };
            now.moved(self);
        }
        let own = now.maps.maps(matches!(material.lobe, Lobe::Ggx(_)), textures);
        let TextureMaps { kd, ks, ns, ke, d, pr, pm, norm, bump } = &mut now.maps;
        let gone = |own: Option<Entity>, rendered: Option<Entity>| own.is_some() && rendered.is_none();
        let slots = [
            (gone(own.diffuse, maps.diffuse), vec![kd]),
            (gone(own.specular, maps.specular), vec![ks]),
            (gone(own.lobe, maps.lobe), vec![ns, pr]),
            (gone(own.metallic, maps.metallic), vec![pm]),
            (gone(own.emission, maps.emission), vec![ke]),
            (gone(own.opacity, maps.opacity), vec![d]),
            (gone(own.relief, maps.relief), vec![norm, bump]),
        ];
        for (_, slots) in slots.into_iter().filter(|(gone, _)| *gone) {
            slots.into_iter().flatten().for_each(|map| map.off = true);
        }
        now
    }
}
