//! Lights that are changed while a film is traced.

use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{Camera, Integrator, Material, PointLight, Render, Transform};
use lucerna::layout::film::FilmPixel;
use lucerna::scene::SceneDescription;
use lucerna::shader::Library;

use super::{bulb, spot};
use crate::support;
use crate::support::stage::{Stage, matte, quad};

/// A floor under a bulb and a spot.
fn scene() -> SceneDescription {
    let mut stage = Stage::new(UVec2::splat(12), 3, DVec3::new(0.0, 1.0, 3.0), DVec3::ZERO);
    stage.part(&quad(Vec3::new(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), matte(Vec3::splat(0.5)));
    let mut scene = lucerna::scene::describe(stage.world(), "lit");
    scene.render.spp = 2;
    scene.lights.insert("bulb".into(), bulb(DVec3::new(0.2, 1.0, 0.3), Vec3::new(1.0, 2.0, 3.0)));
    scene.lights.insert("spot".into(), spot(DVec3::new(-1.0, 2.0, 0.0), DVec3::ZERO, 40.0, 0.5));
    scene
}

fn film(engine: &mut Engine) -> Vec<FilmPixel> {
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
    engine.film().unwrap().pixels
}

fn open(scene: &SceneDescription) -> Engine {
    Engine::open(support::gpu(), Library::shipped(), scene).unwrap()
}

fn light<'w>(world: &'w mut World, name: &str) -> Mut<'w, PointLight> {
    let mut query = world.query::<(&Name, &mut PointLight)>();
    query.iter_mut(world).find(|(other, _)| other.as_str() == name).expect("the light").1
}

type Edit = fn(&mut World);

#[test]
fn edits_end_where_a_fresh_engine_begins() {
    let edits: [(&str, Edit); 9] = [
        ("moved", |world| light(world, "bulb").position.x += 0.25),
        ("dimmed", |world| light(world, "spot").intensity *= 0.5),
        ("widened", |world| light(world, "spot").cone.as_mut().unwrap().angle = 70.0),
        ("put out", |world| light(world, "spot").intensity = Vec3::ZERO),
        ("another by name", |world| {
            world.spawn((Name::new("a"), bulb(DVec3::new(1.0, 0.5, 0.0), Vec3::ONE)));
        }),
        ("a lamp of triangles", |world| {
            world.query::<&mut Material>().single_mut(world).unwrap().emission = Vec3::splat(0.5);
        }),
        // With points alone both integrators have one film.
        ("found by hitting", |world| {
            world.query::<&mut Render>().single_mut(world).unwrap().integrator = Integrator::Bsdf
        }),
        // Which moves the origin.
        ("far away", |world| {
            let far = DVec3::new(1e6, 0.0, -1e6);
            for mut place in world.query::<&mut Transform>().iter_mut(world) {
                place.0 = DAffine3::from_translation(far);
            }
            for mut light in world.query::<&mut PointLight>().iter_mut(world) {
                light.position += far;
                light.cone.iter_mut().for_each(|cone| cone.look_at += far);
            }
            for mut camera in world.query::<&mut Camera>().iter_mut(world) {
                (camera.position, camera.look_at) = (camera.position + far, camera.look_at + far);
            }
        }),
        ("gone", |world| {
            let all: Vec<Entity> = world.query_filtered::<Entity, With<PointLight>>().iter(world).collect();
            all.into_iter().for_each(|light| assert!(world.despawn(light)));
        }),
    ];
    let mut engine = open(&scene());
    let mut before = film(&mut engine);
    assert!(before.iter().any(|pixel| pixel.halves[0].sum[0] != UVec2::ZERO), "there is light");
    for (what, edit) in edits {
        engine.edit(edit);
        let after = film(&mut engine);
        assert!(after == film(&mut open(&engine.describe("fresh"))), "{what}: a fresh engine has another film");
        assert!(after != before || what == "far away", "{what}: the film stayed");
        before = after;
    }
    assert!(!engine.features().contains("point_lights"), "what is gone is not compiled");
}

#[test]
fn a_light_that_stays_as_it_was_keeps_the_film() {
    let mut engine = open(&scene());
    film(&mut engine);
    let entered = engine.entered().clone();
    engine.edit(|world| light(world, "bulb").set_changed());
    let step = engine.step(Duration::from_millis(100)).unwrap();
    assert_eq!((step.samples, step.finished), (0, true));
    let again = engine.entered().clone();
    assert_ne!(entered["extract_lights"], again["extract_lights"]);
    // A description that says the same changes nothing at all.
    engine.apply(&scene());
    engine.step(Duration::from_millis(100)).unwrap();
    assert_eq!(*engine.entered(), again);
}

/// A film keeps what arrives, however far away the light is that sends it: its step is set by what the scene gets.
#[test]
fn what_a_far_light_sends_fits_the_film() {
    let mut scene = scene();
    scene.lights.clear();
    scene.render.max_depth = 2;
    scene.cameras.values_mut().for_each(|camera| (camera.position, camera.up) = (DVec3::Y, DVec3::Z));
    scene.cameras.values_mut().for_each(|camera| camera.fov_y = 10.0);
    for distance in [1e2, 1e4, 1e6] {
        let intensity = Vec3::splat((distance * distance) as f32);
        scene.lights.insert("far".into(), bulb(DVec3::Y * distance, intensity));
        let mut engine = open(&scene);
        film(&mut engine);
        let rgb = engine.film().unwrap().rgb;
        let mean = rgb.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / rgb.len() as f64;
        let right = 0.5 / std::f64::consts::PI;
        assert!((mean / right - 1.0).abs() < 1e-3, "from {distance:e}: {mean}, not {right}");
    }
}
