//! What a film did not need to have done, with bytes and milliseconds: told by what was measured.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DAffine3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{
    Camera, Geometry, Material, Name, Reading, Render, Texels, Texture, TextureImage, Transform,
};
use lucerna::engine::{Report, Spared, TreeBuilder};
use lucerna::layout::trace::MaterialRecord;
use lucerna::passes::table::TABLE;
use lucerna::prepare::texture::words;
use lucerna::scene::{MapUse, SceneDescription, TextureMap, texture_name};
use lucerna::shader::Library;
use lucerna::stress::scenes::described::{Inside, room};

use crate::support;

fn scene() -> SceneDescription {
    let mut scene = room(UVec2::new(16, 12), Inside::Rough, DAffine3::IDENTITY);
    scene.render = Render { spp: 2, max_depth: 3, ..scene.render };
    scene
}

fn open(scene: &SceneDescription) -> Engine {
    Engine::open(support::gpu(), Library::shipped(), scene).unwrap()
}

fn report(engine: &mut Engine) -> Report {
    while !engine.step(Duration::from_secs(1)).unwrap().finished {}
    engine.report().unwrap()
}

/// A picture of one colour.
fn texture(size: u32) -> Texture {
    let texels = vec![[200, 100, 50, 255]; (size * size) as usize];
    Texture::new(Arc::new(TextureImage { size: UVec2::splat(size), texels: Texels::Rgba8(texels) }), Reading::Colour)
}

#[test]
fn a_first_film_is_spared_nothing() {
    assert_eq!(report(&mut open(&scene())).spared, Spared::default());
}

#[test]
fn what_another_film_finds_on_the_device_is_told_in_bytes() {
    let mut engine = open(&scene());
    let first = report(&mut engine);
    let tables = ["triangles", "shading", "materials", "lights"];
    let sent = |name: &str, engine: &Engine| engine.uploads()[name];
    let bytes: Vec<u64> = tables.iter().map(|name| sent(name, &engine)).collect();
    // Another view needs nothing of that again.
    engine.edit(|world| {
        world.query::<&mut Camera>().iter_mut(world).for_each(|mut camera| camera.position.x += 0.1);
    });
    let spared = report(&mut engine).spared;
    let told: Vec<u64> = tables.iter().map(|name| spared.uploads[name]).collect();
    assert_eq!(told, bytes);
    assert_eq!(spared.upload_bytes(), spared.uploads.values().sum::<u64>());
    let milliseconds = spared.build_milliseconds.expect("the tree was kept");
    assert!((milliseconds - 1e3 * first.seconds_build).abs() < 1e-6, "{milliseconds} ms, {} s", first.seconds_build);
    // Of a material's record, all others.
    engine.edit(|world| {
        world.query::<&mut Material>().iter_mut(world).next().unwrap().diffuse = Vec3::splat(0.123);
    });
    let spared = report(&mut engine).spared;
    assert_eq!(spared.uploads["materials"], bytes[2] - size_of::<MaterialRecord>() as u64);
    assert_eq!(spared.uploads["triangles"], bytes[0]);
    // A mesh that is moved is sent, and has another tree built.
    engine.edit(|world| {
        let mut meshes = world.query_filtered::<(&Name, &mut Transform), With<Geometry>>();
        let (_, mut place) = meshes.iter_mut(world).find(|(name, _)| name.as_str() == "left").unwrap();
        place.0 = DAffine3::from_translation(glam::DVec3::Y * 0.1);
    });
    let spared = report(&mut engine).spared;
    assert!(spared.uploads["triangles"] < bytes[0] && spared.build_milliseconds.is_none(), "{spared:?}");
}

#[test]
fn passes_that_a_film_finds_done_are_told_with_the_time_that_they_took() {
    let mut engine = open(&scene());
    engine.set_tree_builder(TreeBuilder::Passes);
    engine.set_timing(true);
    let timed: Vec<_> = report(&mut engine).passes;
    engine.edit(|world| {
        world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.seed = 7);
    });
    let spared = report(&mut engine).spared;
    assert!(spared.passes.iter().any(|(name, _)| *name == "morton"), "{spared:?}");
    assert!(spared.passes.iter().all(|(name, _)| !["path", "accumulate", "display"].contains(name)), "{spared:?}");
    for (name, milliseconds) in &spared.passes {
        let took = timed.iter().find(|pass| pass.name == *name).map(|pass| pass.milliseconds);
        // All of a tree is one recording; without timestamps nothing is told.
        assert!(*milliseconds == took || took.is_none(), "{name}: {milliseconds:?}, {took:?}");
    }
}

#[test]
fn textures_that_nothing_uses_and_halves_are_told_in_bytes() {
    let mut scene = scene();
    let (used, unused) = (texture(64), texture(32));
    for (name, texture) in [("used", &used), ("unused", &unused)] {
        scene.textures.insert(texture_name(&TextureMap::new(name), MapUse::Colour), texture.clone());
    }
    scene.materials.get_mut("wall 0").unwrap().maps.kd = Some(TextureMap::new("used"));
    let mut engine = open(&scene);
    let spared = report(&mut engine).spared;
    assert_eq!((spared.unused_textures, spared.unused_texture_bytes), (1, 4 * words(&unused, 0)));
    assert_eq!(spared.halved_texture_bytes, 0);
    engine.edit(|world| {
        world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.texture_size = 16);
    });
    let report = report(&mut engine);
    assert_eq!(report.spared.halved_texture_bytes, 4 * (words(&used, 0) - words(&used, 2)));
    assert_eq!(report.spared.unused_texture_bytes, 4 * words(&unused, 1));
    assert_eq!(report.texture_bytes, 4 * words(&used, 2));
}

/// Passes of which a report says what did not happen: that they did not run for the film though they did since `before`, or that they did though
/// they did not.
fn untrue(report: &Report, before: &BTreeMap<&'static str, u64>, engine: &Engine) -> Vec<&'static str> {
    let count = |of: &BTreeMap<&'static str, u64>, name: &str| of.get(name).copied().unwrap_or(0);
    let wrong = |name: &&'static str| {
        let skipped = count(&report.dispatches, name) == 0 || report.spared.passes.iter().any(|(kept, _)| kept == name);
        let ran = count(engine.dispatches(), name) > count(before, name);
        skipped == ran
    };
    TABLE.iter().map(|pass| pass.name).filter(wrong).collect()
}

#[test]
fn what_is_told_of_a_pass_is_what_it_did_and_a_false_word_is_seen() {
    let mut engine = open(&scene());
    engine.set_tree_builder(TreeBuilder::Passes);
    let edits: [fn(&mut World); 4] = [
        |_| {},
        |world| world.query::<&mut Camera>().iter_mut(world).for_each(|mut camera| camera.position.x += 0.1),
        |world| world.query::<&mut Material>().iter_mut(world).next().unwrap().diffuse = Vec3::splat(0.123),
        |world| {
            let mut meshes = world.query_filtered::<&mut Transform, With<Geometry>>();
            meshes.iter_mut(world).next().unwrap().0 = DAffine3::from_translation(glam::DVec3::Y * 0.1);
        },
    ];
    let mut kept = Vec::new();
    for edit in edits {
        let before = engine.dispatches().clone();
        engine.edit(edit);
        let told = report(&mut engine);
        assert_eq!(untrue(&told, &before, &engine), Vec::<&str>::new());
        kept.push(told.spared.passes.len());
        // A report that says of a pass which ran that it did not: because an earlier film had done it, or because nothing did.
        let ran = |name: &&&'static str| engine.dispatches()[**name] > before.get(**name).copied().unwrap_or(0);
        for name in engine.dispatches().keys().filter(|name| ran(name)) {
            let mut false_word = told.clone();
            false_word.spared.passes.push((*name, None));
            assert_eq!(untrue(&false_word, &before, &engine), [*name]);
            let mut false_word = told.clone();
            false_word.dispatches.remove(name);
            assert_eq!(untrue(&false_word, &before, &engine), [*name]);
        }
        for (name, _) in &told.spared.passes {
            let mut false_word = told.clone();
            false_word.spared.passes.retain(|(kept, _)| kept != name);
            assert_eq!(untrue(&false_word, &before, &engine), [*name]);
        }
    }
    // Of a moved mesh the tree is built anew; another view or material keeps it.
    assert!(kept[0] == 0 && kept[1] > 0 && kept[2] > 0 && kept[3] == 0, "{kept:?}");
}
