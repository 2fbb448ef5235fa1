//! The law of edits: whatever was done to a scene, its film is, bit for bit, that of the resulting scene opened fresh.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{Camera, Environment, Film, Geometry, Material, MeshData, Name, Render, Transform};
use lucerna::layout::film::FilmPixel;
use lucerna::scene::{self, MeshEntry, MtlMaterial, SceneDescription};
use lucerna::shader::Library;
use lucerna::stress::tools::edits::{Dice, edit};

use crate::support;

/// A description of what the world holds now: what a fresh engine is opened from.
fn describe(engine: &Engine) -> SceneDescription {
    engine.describe("edited")
}

fn pixels(engine: &mut Engine) -> Vec<FilmPixel> {
    while !engine.step(Duration::from_secs(1)).unwrap().finished {}
    engine.film().unwrap().pixels
}

#[test]
fn a_hundred_edits_end_where_a_fresh_engine_begins() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
    let small = [("film.size", "(20,16)"), ("render.spp", "2"), ("render.max_depth", "4")];
    let small = small.map(|(path, value)| scene::Define::given(path, value));
    let file = scene::load(&path, &small).unwrap().description;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &file).unwrap();
    let mut dice = Dice::new(1);
    let mut lit = 0;
    for i in 0..100 {
        let what = engine.edit(|world| edit(world, &mut dice, &file, None));
        // Half of the edits meet a film that is under way or finished, half come one upon another.
        if dice.roll(2) == 0 {
            engine.step(Duration::from_millis(1)).unwrap();
        }
        if i % 5 != 4 {
            continue;
        }
        let edited = pixels(&mut engine);
        let description = describe(&engine);
        let fresh = pixels(&mut Engine::open(support::gpu(), Library::shipped(), &description).unwrap());
        assert!(edited == fresh, "after edit {i}, {what}, {} pixels differ", count_different(&edited, &fresh));
        lit += usize::from(edited.iter().any(|p| p.halves[0].sum[0] != glam::UVec2::ZERO));
    }
    // With this seed 9 of 20 do.
    assert!(lit >= 8, "only {lit} of 20 films saw any light: black films prove nothing");
}

fn count_different(a: &[FilmPixel], b: &[FilmPixel]) -> usize {
    if a.len() == b.len() { a.iter().zip(b).filter(|(a, b)| a != b).count() } else { a.len().max(b.len()) }
}

#[test]
fn a_scene_far_from_zero_is_the_scene_at_zero() {
    // Powers of two, so that no coordinate is rounded: then the origin takes the whole shift away.
    let quad = |z: f64| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let positions = corners.map(|(x, y)| DVec3::new(x, y, z)).to_vec();
        Arc::new(MeshData { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Default::default() })
    };
    let film = |shift: DVec3| {
        let place = Transform(DAffine3::from_translation(shift));
        let entry =
            |z: f64, material: &str| MeshEntry { geometry: quad(z), transform: place, material: material.into() };
        let lamp = Material { emission: Vec3::splat(3.0), ..Default::default() };
        let description = SceneDescription {
            name: "far".into(),
            meshes: [("a".into(), entry(-0.5, "grey")), ("b".into(), entry(4.0, "lamp"))].into(),
            materials: [("grey".into(), MtlMaterial::default()), ("lamp".into(), lamp.into())].into(),
            textures: Default::default(),
            cameras: [(
                "front".into(),
                Camera {
                    position: shift + DVec3::Z * 2.0,
                    look_at: shift,
                    up: DVec3::Y,
                    fov_y: 50.0,
                    ..Camera::default()
                },
            )]
            .into(),
            active: "front".into(),
            lights: Default::default(),
            film: Film { size: UVec2::splat(16), ..Default::default() },
            render: Render { spp: 8, ..Default::default() },
            shader: Default::default(),
            environment: None,
        };
        pixels(&mut Engine::open(support::gpu(), Library::shipped(), &description).unwrap())
    };
    let near = film(DVec3::ZERO);
    assert!(near.iter().any(|p| p.halves[0].sum[0] != UVec2::ZERO));
    assert!(film(DVec3::new(2f64.powi(20), -(2f64.powi(21)), 2f64.powi(22))) == near);
}

/// Two quads that face the camera, under a sky.
fn two_quads() -> SceneDescription {
    let entry = |x: f64, count: usize| MeshEntry {
        geometry: quads(count),
        transform: Transform(DAffine3::from_translation(DVec3::X * x)),
        material: "lamp".into(),
    };
    let lamp = Material { emission: Vec3::splat(3.0), ..Default::default() };
    SceneDescription {
        name: "quads".into(),
        meshes: [("a".into(), entry(-1.0, 1)), ("b".into(), entry(1.0, 20))].into(),
        materials: [("lamp".into(), lamp.into())].into(),
        textures: Default::default(),
        cameras: [(
            "front".into(),
            Camera { position: DVec3::Z * 4.0, look_at: DVec3::ZERO, up: DVec3::Y, fov_y: 50.0, ..Camera::default() },
        )]
        .into(),
        active: "front".into(),
        lights: Default::default(),
        film: Film { size: UVec2::splat(16), ..Default::default() },
        render: Render { spp: 4, ..Default::default() },
        shader: Default::default(),
        environment: Some(Environment::Constant(Vec3::splat(0.25))),
    }
}

/// Quads one behind the other.
fn quads(count: usize) -> Arc<MeshData> {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let at = |z: usize| corners.map(|(x, y)| DVec3::new(x, y, -0.01 * z as f64));
    let triangles = (0..count as u32).flat_map(|i| [[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|c| c + 4 * i)));
    Arc::new(MeshData {
        positions: (0..count).flat_map(at).collect(),
        triangles: triangles.collect(),
        ..Default::default()
    })
}

fn by_name(world: &mut World, name: &str) -> Entity {
    let mut names = world.query::<(Entity, &Name)>();
    names.iter(world).find(|(_, found)| found.as_str() == name).unwrap().0
}

/// The film of an engine equals that of its scene opened fresh.
fn assert_law(engine: &mut Engine) {
    let edited = pixels(engine);
    let description = describe(engine);
    let fresh = pixels(&mut Engine::open(support::gpu(), Library::shipped(), &description).unwrap());
    assert!(edited == fresh, "{} pixels differ", count_different(&edited, &fresh));
}

#[test]
fn a_mesh_that_grows_leaves_the_others_as_they_are() {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &two_quads()).unwrap();
    pixels(&mut engine);
    engine.edit(|world| {
        let last = by_name(world, "b");
        world.get_mut::<Geometry>(last).unwrap().0 = quads(200);
    });
    assert_law(&mut engine);
}

#[test]
fn what_an_error_left_half_done_is_done_anew() {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &two_quads()).unwrap();
    pixels(&mut engine);
    let camera = engine.edit(|world| {
        let last = by_name(world, "b");
        world.get_mut::<Geometry>(last).unwrap().0 = quads(400);
        let camera = by_name(world, "front");
        world.entity_mut(camera).take::<Camera>().unwrap()
    });
    assert!(engine.step(Duration::from_millis(1)).is_err(), "there is no camera");
    engine.edit(|world| {
        let last = by_name(world, "b");
        world.get_mut::<Geometry>(last).unwrap().0 = quads(1);
        let front = by_name(world, "front");
        world.entity_mut(front).insert(camera);
    });
    assert_law(&mut engine);
}

#[test]
fn a_mesh_without_a_name_is_none() {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &two_quads()).unwrap();
    pixels(&mut engine);
    engine.step(Duration::from_millis(1)).unwrap();
    engine.edit(|world| {
        let last = by_name(world, "b");
        world.entity_mut(last).remove::<Name>();
    });
    assert_law(&mut engine);
}

#[test]
fn a_scene_may_have_no_triangles_at_any_time() {
    let mut description = two_quads();
    let meshes = std::mem::take(&mut description.meshes);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    pixels(&mut engine);
    assert_eq!(engine.film().unwrap().rgb, [[0.25; 3]; 256]);
    description.meshes = meshes;
    engine.edit(|world| scene::apply(world, &description));
    assert_law(&mut engine);
    assert_ne!(engine.film().unwrap().rgb, [[0.25; 3]; 256]);
    description.meshes.clear();
    engine.edit(|world| scene::apply(world, &description));
    assert_law(&mut engine);
    assert_eq!(engine.film().unwrap().rgb, [[0.25; 3]; 256]);
}

#[test]
fn a_scene_may_come_to_have_few_triangles_or_more() {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &two_quads()).unwrap();
    // Beside the two of another mesh.
    for (count, few) in [(15, true), (16, false), (15, true)] {
        engine.edit(|world| {
            let last = by_name(world, "b");
            world.get_mut::<Geometry>(last).unwrap().0 = quads(count);
        });
        assert_law(&mut engine);
        assert_eq!(engine.features().contains("few_triangles"), few, "{count}");
    }
}
