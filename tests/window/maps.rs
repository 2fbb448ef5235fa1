//! Maps that the panel switches off and exchanges: on components alone.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::Vec3;
use lucerna::components::{Channel, Maps, Material, Name, Reading, Texture, TextureImage};
use lucerna::scene::{MapUse, MtlMaterial, SceneDescription, TextureMap, apply, describe, load};

/// A scene whose material has two maps, one of which counts alone, and the texture of another file.
pub fn description() -> SceneDescription {
    let mut scene = load(Path::new("assets/scenes/cornell-data.ron"), &[]).unwrap().description;
    let material = scene.materials.values_mut().next().unwrap();
    material.kd = Vec3::ONE;
    material.maps.kd = Some(TextureMap { alone: true, ..TextureMap::new("wood.png") });
    material.maps.d = Some(TextureMap::new("leaf.png"));
    for (file, reading) in [
        ("wood.png, colour", Reading::Colour),
        ("oak.png, colour", Reading::Colour),
        ("leaf.png, number", Reading::Number(Channel::Luminance)),
    ] {
        scene.textures.insert(file.to_owned(), Texture::new(Arc::new(TextureImage::grey(128)), reading));
    }
    scene
}

/// Edits the material as the panel does.
fn edit(world: &mut World, edit: impl FnOnce(&mut MtlMaterial)) {
    let mut query = world.query_filtered::<(&Name, Entity), With<Texture>>();
    let textures: BTreeMap<String, Entity> =
        query.iter(world).map(|(name, entity)| (name.as_str().to_owned(), entity)).collect();
    let mut query = world.query::<(&mut MtlMaterial, &mut Material, &mut Maps)>();
    let (mut numbers, mut material, mut maps) =
        query.iter_mut(world).find(|(numbers, ..)| numbers.maps.uses().next().is_some()).unwrap();
    let before = numbers.clone();
    edit(&mut numbers);
    numbers.moved(&before);
    (*material, *maps) = numbers.rendered(&textures);
}

fn mapped(world: &mut World) -> (Material, Maps) {
    let mut query = world.query::<(&MtlMaterial, &Material, &Maps)>();
    let found = query.iter(world).find(|(numbers, ..)| numbers.maps.uses().next().is_some()).unwrap();
    (*found.1, *found.2)
}

/// A world made anew of what this one holds has the same materials and textures.
fn assert_same_when_opened_fresh(world: &mut World) {
    let described = describe(world, "s");
    let mut other = World::new();
    apply(&mut other, &described);
    assert_eq!(describe(&other, "s"), described);
    let of = |world: &mut World| {
        let (material, maps) = mapped(world);
        let name = |entity: Option<Entity>| entity.map(|entity| world.get::<Name>(entity).unwrap().to_string());
        (material, name(maps.diffuse), name(maps.opacity))
    };
    assert_eq!(of(world), of(&mut other));
}

#[test]
fn a_map_is_switched_off_and_on() {
    let mut world = World::new();
    apply(&mut world, &description());
    let (material, maps) = mapped(&mut world);
    assert!(maps.diffuse.is_some() && maps.opacity.is_some());
    edit(&mut world, |numbers| numbers.maps.kd.as_mut().unwrap().off = true);
    let off = mapped(&mut world);
    // The number that nobody gave is the default without the map.
    assert_eq!((off.1.diffuse, off.0.diffuse), (None, MtlMaterial::default().kd));
    assert_eq!(off.1.opacity, maps.opacity);
    assert_same_when_opened_fresh(&mut world);
    edit(&mut world, |numbers| numbers.maps.kd.as_mut().unwrap().off = false);
    assert_eq!(mapped(&mut world), (material, maps));
    assert_same_when_opened_fresh(&mut world);
}

#[test]
fn a_map_is_exchanged_for_one_that_is_there_or_gives_way_to_the_plain_colour() {
    let mut world = World::new();
    apply(&mut world, &description());
    let wood = mapped(&mut world).1.diffuse;
    edit(&mut world, |numbers| numbers.maps.kd.as_mut().unwrap().file = "oak.png".into());
    let (material, maps) = mapped(&mut world);
    assert!(maps.diffuse.is_some() && maps.diffuse != wood);
    assert_eq!(material.diffuse, Vec3::ONE);
    assert_same_when_opened_fresh(&mut world);
    edit(&mut world, |numbers| numbers.maps.kd.as_mut().unwrap().file = "none.png".into());
    assert_eq!(mapped(&mut world).1.diffuse, None);
    assert_eq!(mapped(&mut world).0.diffuse, MtlMaterial::default().kd);
}

#[test]
fn a_number_that_was_moved_counts_without_the_map_too() {
    let mut world = World::new();
    apply(&mut world, &description());
    edit(&mut world, |numbers| numbers.kd = Vec3::splat(0.25));
    edit(&mut world, |numbers| numbers.maps.kd.as_mut().unwrap().off = true);
    assert_eq!(mapped(&mut world).0.diffuse, Vec3::splat(0.25));
}

#[test]
fn components_that_were_edited_by_themselves_are_described_as_they_are() {
    let mut world = World::new();
    apply(&mut world, &description());
    let mut query = world.query::<(&mut Material, &mut Maps)>();
    for (mut material, mut maps) in query.iter_mut(&mut world) {
        if maps.diffuse.is_some() {
            (material.diffuse, maps.opacity) = (Vec3::splat(0.125), None);
        }
    }
    let (material, maps) = mapped(&mut world);
    assert!(material.diffuse == Vec3::splat(0.125) && maps.diffuse.is_some() && maps.opacity.is_none());
    assert_same_when_opened_fresh(&mut world);
}

#[test]
fn maps_are_told_apart_by_use() {
    let description = description();
    let uses: Vec<MapUse> = description.materials.values().flat_map(|m| m.maps.uses()).map(|(_, used)| used).collect();
    assert_eq!(uses, [MapUse::Colour, MapUse::Number]);
}
