//! A description to entities: only what differs is written, so that change detection sees what changed and no more.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;

use super::description::{MeshEntry, SceneDescription};
use super::mtl::MtlMaterial;
use super::settings::{SETTINGS, Settings};
use crate::components::{
    self, Active, Camera, Environment, Film, Geometry, Lobe, Material, Name, PointLight, Render, ShaderValues, Texture,
    UsesMaterial,
};

/// Makes the world hold exactly the scene that `description` describes, entity by entity, matched by `Name`.
///
/// What is equal stays untouched: applying the same description again changes nothing. Entities of these kinds whose
/// names are not in the description, or that have none, are despawned.
pub fn apply(world: &mut World, description: &SceneDescription) {
    apply_changes(world, None, description);
}

/// The same, but leaves alone what is in the description as it was in an earlier one: what was edited since stays so.
pub fn apply_changes(world: &mut World, earlier: Option<&SceneDescription>, description: &SceneDescription) {
    components::register(world);
    world.register_component::<MtlMaterial>();
    let textures = match_by_name::<Texture>(world, description.textures.keys());
    for (name, texture) in &description.textures {
        apply_texture(world, textures[name], texture);
    }
    let materials = match_by_name::<Material>(world, description.materials.keys());
    for (name, material) in &description.materials {
        apply_material(world, materials[name], earlier.and_then(|e| e.materials.get(name)), material, &textures);
    }
    let meshes = match_by_name::<Geometry>(world, description.meshes.keys());
    for (name, mesh) in &description.meshes {
        let material = materials.get(&mesh.material).copied();
        apply_mesh(world, meshes[name], earlier.and_then(|e| e.meshes.get(name)), mesh, material);
    }
    let cameras = match_by_name::<Camera>(world, description.cameras.keys());
    for (name, camera) in &description.cameras {
        set_change(world, cameras[name], earlier.and_then(|e| e.cameras.get(name)), camera);
    }
    let chosen = earlier.is_some_and(|e| e.active == description.active);
    if !chosen || !cameras.values().any(|camera| world.get::<Active>(*camera).is_some()) {
        for (name, camera) in &cameras {
            mark_active(world, *camera, *name == description.active);
        }
    }
    let lights = match_by_name::<PointLight>(world, description.lights.keys());
    for (name, light) in &description.lights {
        set_change(world, lights[name], earlier.and_then(|e| e.lights.get(name)), light);
    }
    let film = match_by_name::<Film>(world, [&"film".to_owned()])["film"];
    apply_settings(world, film, earlier, description);
    apply_values(world, film, earlier.map(|e| &e.shader), &description.shader);
    let name = "environment".to_owned();
    let environments = match_by_name::<Environment>(world, description.environment.iter().map(|_| &name));
    if let Some(environment) = &description.environment {
        set_change(world, environments[&name], earlier.and_then(|e| e.environment.as_ref()), environment);
    }
}

/// One entity for each name: found by its `Name` among those with a `Kind`, or spawned. Others of the kind are despawned.
fn match_by_name<'n, Kind: Component>(
    world: &mut World,
    names: impl IntoIterator<Item = &'n String>,
) -> BTreeMap<String, Entity> {
    let wanted: BTreeSet<&str> = names.into_iter().map(String::as_str).collect();
    let mut found = BTreeMap::new();
    let mut gone = Vec::new();
    let mut query = world.query_filtered::<(Entity, Option<&Name>), With<Kind>>();
    let mut present: Vec<(Entity, Option<&Name>)> = query.iter(world).collect();
    present.sort_by_key(|(entity, _)| *entity);
    for (entity, name) in present {
        match name.filter(|name| wanted.contains(name.as_str()) && !found.contains_key(name.as_str())) {
            Some(name) => {
                found.insert(name.as_str().to_owned(), entity);
            }
            None => gone.push(entity),
        }
    }
    for entity in gone {
        world.despawn(entity);
    }
    for name in wanted {
        if !found.contains_key(name) {
            found.insert(name.to_owned(), world.spawn(Name::new(name.to_owned())).id());
        }
    }
    found
}

/// Writes what differs of a texture. An equal picture keeps the shared data that is there, whenever it was read.
fn apply_texture(world: &mut World, entity: Entity, texture: &Texture) {
    let kept = match world.get::<Texture>(entity) {
        Some(held) if Arc::ptr_eq(&held.image, &texture.image) || held.image == texture.image => held.image.clone(),
        _ => texture.image.clone(),
    };
    let same = |held: &Texture| Arc::ptr_eq(&held.image, &kept) && held.is_read_as(texture);
    if !world.get::<Texture>(entity).is_some_and(same) {
        world.entity_mut(entity).insert(Texture { image: kept, ..texture.clone() });
    }
}

/// Writes a material and what it comes to, unless the description says what it said earlier. Which textures there are may be
/// otherwise all the same.
fn apply_material(
    world: &mut World,
    entity: Entity,
    earlier: Option<&MtlMaterial>,
    numbers: &MtlMaterial,
    textures: &BTreeMap<String, Entity>,
) {
    if earlier != Some(numbers) || world.get::<Material>(entity).is_none() {
        set(world, entity, numbers);
        set(world, entity, &numbers.material());
    }
    // What is held may have been edited since: its maps are the ones that count.
    let held = world.get::<MtlMaterial>(entity).map(|held| (held.maps.clone(), world.get::<Material>(entity)));
    if let Some((maps, Some(material))) = held {
        let maps = maps.maps(matches!(material.lobe, Lobe::Ggx(_)), textures);
        set(world, entity, &maps);
    }
}

/// Writes a component if it differs from what is there, unless the description says what it said earlier.
fn set_change<T: Component<Mutability = Mutable> + Clone + PartialEq>(
    world: &mut World,
    entity: Entity,
    earlier: Option<&T>,
    value: &T,
) {
    if earlier != Some(value) || world.get::<T>(entity).is_none() {
        set(world, entity, value);
    }
}

/// Writes a component if it differs from what is there.
fn set<T: Component<Mutability = Mutable> + Clone + PartialEq>(world: &mut World, entity: Entity, value: &T) {
    match world.get::<T>(entity) {
        Some(held) if held == value => {}
        Some(_) => *world.get_mut::<T>(entity).expect("invariant: it was just read") = value.clone(),
        None => {
            world.entity_mut(entity).insert(value.clone());
        }
    }
}

/// Writes the settings, each of them unless the description says what it said earlier.
fn apply_settings(world: &mut World, film: Entity, earlier: Option<&SceneDescription>, description: &SceneDescription) {
    let of = |scene: &SceneDescription| Settings { film: scene.film, render: scene.render };
    let wanted = of(description);
    let held = world.get::<Film>(film).copied().zip(world.get::<Render>(film).copied());
    let now = match (earlier.map(of), held) {
        (Some(earlier), Some((film, render))) => {
            let mut now = Settings { film, render };
            let others = SETTINGS.iter().filter(|setting| !setting.is_same(&earlier, &wanted));
            others.for_each(|setting| setting.copy(&wanted, &mut now));
            now
        }
        _ => wanted,
    };
    set(world, film, &now.film);
    set(world, film, &now.render);
}

/// Writes the parameters of shaders, each of them unless the description says what it said earlier.
fn apply_values(world: &mut World, film: Entity, earlier: Option<&ShaderValues>, values: &ShaderValues) {
    let mut now = match earlier {
        Some(_) => world.get::<ShaderValues>(film).cloned().unwrap_or_default(),
        None => values.clone(),
    };
    if let Some(earlier) = earlier {
        let gone = |name: &String| earlier.0.contains_key(name) && !values.0.contains_key(name);
        now.0.retain(|name, _| !gone(name));
        let others = values.0.iter().filter(|(name, value)| earlier.0.get(*name) != Some(value));
        now.0.extend(others.map(|(name, value)| (name.clone(), *value)));
    }
    set(world, film, &now);
}

/// Writes what differs of a mesh. Equal geometry keeps the shared data that is there, wherever it was read from.
fn apply_mesh(
    world: &mut World,
    entity: Entity,
    earlier: Option<&MeshEntry>,
    mesh: &MeshEntry,
    material: Option<Entity>,
) {
    let same = |held: &Geometry| Arc::ptr_eq(&held.0, &mesh.geometry) || held.0 == mesh.geometry;
    if !world.get::<Geometry>(entity).is_some_and(same) {
        world.entity_mut(entity).insert(Geometry(mesh.geometry.clone()));
    }
    set_change(world, entity, earlier.map(|e| &e.transform), &mesh.transform);
    match material {
        Some(material) => set(world, entity, &UsesMaterial(material)),
        None => {
            world.entity_mut(entity).remove::<UsesMaterial>();
        }
    }
}

/// Adds or removes the mark of the camera that is rendered.
fn mark_active(world: &mut World, entity: Entity, active: bool) {
    match (world.get::<Active>(entity).is_some(), active) {
        (false, true) => {
            world.entity_mut(entity).insert(Active);
        }
        (true, false) => {
            world.entity_mut(entity).remove::<Active>();
        }
        _ => {}
    }
}
