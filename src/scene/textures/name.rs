//! The names of textures, and what each map of a material is read as.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use crate::components::{Maps, Wrap};
use crate::scene::mtl::{MtlMaterial, TextureMap, TextureMaps};

/// What a map is looked up for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MapUse {
    /// sRGB.
    Colour,
    Number,
    Normal,
    /// Heights; directions where the picture is one of those.
    Bump,
}

/// The name of the texture that a map comes to: equal for maps that read the same file in the same way, in whatever material.
pub fn name(map: &TextureMap, used: MapUse) -> String {
    let TextureMap { file, wrap, scale, offset, gain, base, channel, bump, flip_green, alone: _, off: _ } = map;
    let mut name = match used {
        MapUse::Colour => format!("{}, colour", file.display()),
        MapUse::Number => format!("{}, number", file.display()),
        MapUse::Normal => format!("{}, directions", file.display()),
        MapUse::Bump => format!("{}, relief of {bump}", file.display()),
    };
    if *scale != glam::Vec2::ONE || *offset != glam::Vec2::ZERO {
        name += &format!(", uv * ({}, {}) + ({}, {})", scale.x, scale.y, offset.x, offset.y);
    }
    for (axis, wrap) in ["u", "v"].iter().zip(wrap) {
        if *wrap == Wrap::Clamp {
            name += &format!(", {axis} clamped");
        }
    }
    if (*gain, *base) != (1.0, 0.0) {
        name += &format!(", {base} + {gain} x");
    }
    if let Some(channel) = channel.filter(|_| matches!(used, MapUse::Number | MapUse::Bump)) {
        name += &format!(", {channel:?}");
    }
    if *flip_green && matches!(used, MapUse::Normal | MapUse::Bump) {
        name += ", green flipped";
    }
    name
}

impl TextureMaps {
    /// The maps there are, those that are off too, each with what it is looked up for.
    pub fn uses(&self) -> impl Iterator<Item = (&TextureMap, MapUse)> {
        let Self { kd, ks, ns, ke, d, pr, pm, norm, bump } = self;
        let colours = [kd, ks, ke].map(|map| (map, MapUse::Colour));
        let numbers = [ns, d, pr, pm].map(|map| (map, MapUse::Number));
        let relief = [(norm, MapUse::Normal), (bump, MapUse::Bump)];
        colours.into_iter().chain(numbers).chain(relief).filter_map(|(map, used)| Some((map.as_ref()?, used)))
    }

    /// Those that are on as entities, by the names of the textures that are there. A lobe that is GGX by `pr` has no use for `ns`.
    pub fn maps(&self, ggx: bool, textures: &BTreeMap<String, Entity>) -> Maps {
        let find = |map: &Option<TextureMap>, used| {
            let map = map.as_ref().filter(|map| !map.off)?;
            textures.get(&name(map, used)).copied()
        };
        Maps {
            diffuse: find(&self.kd, MapUse::Colour),
            specular: find(&self.ks, MapUse::Colour),
            lobe: if ggx { find(&self.pr, MapUse::Number) } else { find(&self.ns, MapUse::Number) },
            metallic: find(&self.pm, MapUse::Number),
            emission: find(&self.ke, MapUse::Colour),
            opacity: find(&self.d, MapUse::Number),
            relief: find(&self.norm, MapUse::Normal).or_else(|| find(&self.bump, MapUse::Bump)),
        }
    }
}

impl MtlMaterial {
    /// The maps that a surface of this material looks up: one lobe's, and one relief.
    pub fn seen_maps(&self) -> impl Iterator<Item = (&TextureMap, MapUse)> {
        let Self { pr, maps, .. } = self;
        let unseen_lobe = if pr.is_some() { &maps.ns } else { &maps.pr };
        let directions = maps.norm.as_ref().is_some_and(|map| map.file.is_file());
        let unseen_relief = if directions { &maps.bump } else { &None };
        let is =
            |slot: &Option<TextureMap>, map: &TextureMap| slot.as_ref().is_some_and(|slot| std::ptr::eq(slot, map));
        maps.uses().filter(move |(map, _)| !is(unseen_lobe, map) && !is(unseen_relief, map))
    }
}
