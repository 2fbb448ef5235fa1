//! Random changes of a scene, of every kind, such as the window makes them.

use std::collections::BTreeMap;

use bevy_ecs::entity::Entity;
use glam::{DVec2, DVec3, UVec2, Vec3};
use lucerna::components::{Crop, Environment, Focus, ShaderValue};
use lucerna::scene::settings::{SETTINGS, Settings, Value as SettingValue};
use lucerna::scene::{KEYS, MtlMaterial, SceneDescription, TextureMap, Value};

use crate::support::dice::Dice;

/// How many kinds there are.
pub const KINDS: usize = 8;

/// Changes one thing.
pub fn change(scene: &mut SceneDescription, kind: usize, dice: &mut Dice) {
    match kind {
        0 => change_camera(scene, dice),
        1 => scene.active = pick(dice, scene.cameras.keys()).clone(),
        2 => change_setting(scene, dice),
        3 => change_light(scene, dice),
        4 => change_environment(scene, dice),
        5 => change_number(scene, dice),
        6 => change_map(scene, dice),
        _ => change_parameter(scene, dice),
    }
}

fn pick<T>(dice: &mut Dice, from: impl IntoIterator<Item = T>) -> T {
    let mut all: Vec<T> = from.into_iter().collect();
    let at = whole(dice, all.len());
    all.swap_remove(at)
}

fn whole(dice: &mut Dice, below: usize) -> usize {
    ((dice.unit() * below as f64) as usize).min(below - 1)
}

/// A number with many digits, a few, or a size that is rare.
fn number(dice: &mut Dice, least: f64, most: f64) -> f64 {
    let value = least + (most - least) * dice.unit();
    match whole(dice, 4) {
        0 => (value * 8.0).round() / 8.0,
        1 => least + (value - least) * 1e-9,
        _ => value,
    }
    .clamp(least, most)
}

fn vector(dice: &mut Dice, most: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| number(dice, -most, most)))
}

fn colour(dice: &mut Dice, most: f32) -> Vec3 {
    match whole(dice, 3) {
        0 => Vec3::splat(number(dice, 0.0, most.into()) as f32),
        _ => Vec3::from_array([(); 3].map(|()| number(dice, 0.0, most.into()) as f32)),
    }
}

fn change_camera(scene: &mut SceneDescription, dice: &mut Dice) {
    let name = scene.active.clone();
    let camera = scene.cameras.get_mut(&name).expect("the camera that is rendered");
    match whole(dice, 6) {
        0 => camera.position += 0.1 * vector(dice, 1.0),
        1 => camera.look_at += 0.1 * vector(dice, 1.0),
        2 => camera.fov_y = number(dice, 1.0, 170.0),
        3 => camera.lens.aperture = number(dice, 0.0, 3.0),
        4 => camera.lens.shift = DVec2::new(number(dice, -1.0, 1.0), 0.25),
        _ => {
            let ahead = camera.position + 0.5 * (camera.look_at - camera.position);
            camera.lens.focus = pick(dice, [Focus::LookAt, Focus::Distance(0.1 + ahead.x.abs()), Focus::At(ahead)]);
        }
    }
}

fn change_setting(scene: &mut SceneDescription, dice: &mut Dice) {
    let mut settings = Settings { film: scene.film, render: scene.render };
    let setting = pick(dice, SETTINGS);
    match setting.value {
        SettingValue::Whole { least, at, .. } => *at(&mut settings) = least + whole(dice, 900) as u32,
        SettingValue::Stops { most, at, .. } => *at(&mut settings) = number(dice, (-most).into(), most.into()) as f32,
        SettingValue::Switch(at) => *at(&mut settings) ^= true,
        SettingValue::Choice(at) => {
            let choice = at(&mut settings);
            choice.choose(whole(dice, choice.words().len()));
        }
        SettingValue::Size(at) => *at(&mut settings) = UVec2::new(64 + whole(dice, 900) as u32, 64),
        SettingValue::Crop(at) => {
            let crop = Crop { min: UVec2::new(1, 2), max: UVec2::new(20 + whole(dice, 9) as u32, 40) };
            *at(&mut settings) = pick(dice, [None, Some(crop)]);
        }
    }
    (scene.film, scene.render) = (settings.film, settings.render);
}

fn change_light(scene: &mut SceneDescription, dice: &mut Dice) {
    if scene.lights.is_empty() {
        return;
    }
    let name = pick(dice, scene.lights.keys()).clone();
    let light = scene.lights.get_mut(&name).expect("a light");
    match (whole(dice, 4), &mut light.cone) {
        (0, Some(cone)) => cone.angle = number(dice, 1.0, 90.0),
        (1, Some(cone)) => cone.blend = number(dice, 0.0, 1.0),
        (2, Some(cone)) => cone.look_at = light.position + DVec3::X + 0.1 * vector(dice, 1.0),
        (3, _) => light.position += 0.01 * vector(dice, 1.0),
        _ => light.intensity = colour(dice, 1e4),
    }
}

fn change_environment(scene: &mut SceneDescription, dice: &mut Dice) {
    match &mut scene.environment {
        Some(Environment::Constant(radiance)) => *radiance = colour(dice, 5.0),
        Some(Environment::Map { strength, tint, .. }) => {
            (*strength, *tint) = (number(dice, 0.0, 3.0) as f32, colour(dice, 2.0));
        }
        Some(Environment::Daylight(day)) => match whole(dice, 6) {
            0 => day.elevation = number(dice, 0.0, 90.0),
            1 => day.azimuth = number(dice, -180.0, 180.0),
            2 => day.turbidity = number(dice, 1.0, 10.0) as f32,
            3 => day.ground = colour(dice, 1.0),
            4 => day.strength = number(dice, 0.0, 9.0) as f32,
            _ => day.sun_size = number(dice, 0.1, 9.0),
        },
        none => *none = Some(Environment::Constant(colour(dice, 1.0))),
    }
}

/// Edits a material as the panel does.
fn edit_material(scene: &mut SceneDescription, name: &str, edit: impl FnOnce(&mut MtlMaterial)) {
    let textures: BTreeMap<String, Entity> =
        scene.textures.keys().map(|name| (name.clone(), Entity::PLACEHOLDER)).collect();
    let material = scene.materials.get_mut(name).expect("a material");
    let before = material.clone();
    edit(material);
    material.moved(&before);
    material.rendered(&textures);
}

fn change_number(scene: &mut SceneDescription, dice: &mut Dice) {
    let Some(name) = used(scene, dice, |_| true) else { return };
    let key = pick(dice, KEYS.iter().filter(|key| !matches!(key.value, Value::Map(..))));
    edit_material(scene, &name, |material| match key.value {
        Value::Colour(kind, at) => *at(material) = colour(dice, kind.most_in_scene()),
        Value::Number(range, at) => *at(material) = number(dice, range.least.into(), range.most.into()) as f32,
        Value::Optional(range, at) => {
            let some = number(dice, range.least.into(), range.most.into()) as f32;
            *at(material) = pick(dice, [None, Some(some), Some(some)]);
        }
        Value::Switch(at) => *at(material) ^= true,
        Value::Whole(most, at) => *at(material) = whole(dice, most as usize) as u32,
        Value::Map(..) => {}
    });
}

/// Off, on, or another picture that the scene has for the same.
fn change_map(scene: &mut SceneDescription, dice: &mut Dice) {
    let Some(name) = used(scene, dice, |material| material.maps.uses().next().is_some()) else { return };
    let slots: Vec<_> = KEYS
        .iter()
        .filter_map(|key| if let Value::Map(used, at) = key.value { Some((used, at)) } else { None })
        .collect();
    let has = |slot: &&(_, fn(&mut MtlMaterial) -> &mut Option<TextureMap>)| {
        slot.1(&mut scene.materials[&name].clone()).is_some()
    };
    let (used, at) = *pick(dice, slots.iter().filter(has));
    let others: Vec<TextureMap> = scene
        .materials
        .values()
        .flat_map(|material| material.maps.uses().filter(|(_, other)| *other == used))
        .map(|(map, _)| map.clone())
        .collect();
    let other = pick(dice, others);
    let switch = dice.unit() < 0.5;
    edit_material(scene, &name, |material| {
        let map = at(material).as_mut().expect("a map");
        match switch {
            true => map.off ^= true,
            false => *map = TextureMap { alone: map.alone, off: map.off, ..other },
        }
    });
}

/// A material that a mesh has.
fn used(scene: &SceneDescription, dice: &mut Dice, fits: impl Fn(&MtlMaterial) -> bool) -> Option<String> {
    let mut names: Vec<&String> = scene.meshes.values().map(|mesh| &mesh.material).collect();
    names.sort();
    names.dedup();
    names.retain(|name| scene.materials.get(*name).is_some_and(&fits));
    if names.is_empty() { None } else { Some(pick(dice, names).clone()) }
}

fn change_parameter(scene: &mut SceneDescription, dice: &mut Dice) {
    let name = pick(dice, ["WIDTH", "height", "ON", "MANY"]).to_owned();
    let value = ShaderValue::Number(number(dice, -9.0, 9.0));
    let switch = ShaderValue::Switch(dice.unit() < 0.5);
    match pick(dice, [None, Some(value), Some(switch)]) {
        Some(value) => _ = scene.shader.0.insert(name, value),
        None => _ = scene.shader.0.remove(&name),
    }
}
