//! What is rendered of a material's numbers and maps, by the textures that are there.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::mtl::MtlMaterial;
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
}
