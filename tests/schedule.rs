//! What each kind of edit makes run: which systems are entered, and which buffers are written.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{
    Camera, Daylight, Energy, Environment, EnvironmentMap, Film, Geometry, Integrator, Maps, Material, MeshData, Name,
    Reading, Render, Texels, Texture, TextureImage, Transform,
};
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

type Counts = BTreeMap<&'static str, u64>;

fn open() -> Engine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
    let defines =
        [("film.size", "(16,16)"), ("render.spp", "2")].map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    finish(&mut engine);
    engine
}

fn finish(engine: &mut Engine) {
    while !engine.step(Duration::from_secs(10)).unwrap().finished {}
}

/// Writes to the first component of a kind, by the names of entities.
fn change<C: Component<Mutability = Mutable>>(world: &mut World, what: impl Fn(&mut C)) {
    let mut entities = world.query::<(&Name, &mut C)>();
    let first = entities.iter(world).map(|(name, _)| name.to_string()).min().unwrap();
    entities.iter_mut(world).filter(|(name, _)| name.as_str() == first).for_each(|(_, mut held)| what(&mut held));
}

fn since(now: &Counts, before: &Counts) -> Counts {
    now.iter().map(|(name, n)| (*name, n - before.get(name).unwrap_or(&0))).filter(|(_, n)| *n > 0).collect()
}

/// Systems that were entered, and bytes written by buffer, from an edit to the finished film.
fn after(engine: &mut Engine, edit: impl FnOnce(&mut World)) -> (Vec<&'static str>, Counts) {
    let (entered, uploads) = (engine.entered().clone(), engine.uploads().clone());
    engine.edit(edit);
    finish(engine);
    (since(engine.entered(), &entered).into_keys().collect(), since(engine.uploads(), &uploads))
}

/// Tracing from the first sample to the picture.
const FILM: [&str; 6] =
    ["accumulate_batch", "begin_film", "plan_batch", "record_batch", "record_picture", "restart_film"];

fn with<'a>(extraction: &[&'a str], rest: &[&'a str]) -> Vec<&'a str> {
    let mut all: Vec<&str> = extraction.iter().chain(rest).copied().chain(["submit_frame"]).collect();
    all.sort_unstable();
    all
}

#[test]
fn nothing_is_entered_for_a_finished_film() {
    let mut engine = open();
    let (entered, uploads) = after(&mut engine, |_| {});
    assert!(entered.is_empty() && uploads.is_empty(), "{entered:?} {uploads:?}");
}

#[test]
fn a_moved_camera_enters_no_system_of_meshes_materials_lights_or_sky_and_sends_parameters_alone() {
    let mut engine = open();
    let (entered, uploads) = after(&mut engine, |w| change::<Camera>(w, |camera| camera.position.x += 0.25));
    assert_eq!(entered, with(&["extract_shot"], &FILM));
    assert_eq!(uploads.keys().copied().collect::<Vec<_>>(), ["params"], "{uploads:?}");
    assert!(uploads["params"] < 4096, "{uploads:?}");
}

type Edit = fn(&mut World);

/// An edit by its name, what it enters beside tracing, and the buffers that it writes beside parameters.
type Row = (&'static str, Edit, &'static [&'static str], &'static [&'static str]);

const RESTARTS: &[Row] = &[
    ("film size", |w| change::<Film>(w, |f| f.size.x += 1), &["extract_shot"], &[]),
    ("seed", |w| change::<Render>(w, |r| r.seed += 1), &["extract_policy", "extract_shot"], &[]),
    (
        "a material's numbers",
        |w| change::<Material>(w, |m| m.diffuse *= 0.5),
        &["extract_materials", "extract_lights", "extract_shot", "materials"],
        &["materials"],
    ),
    (
        "emission",
        |w| set_emission(w, 0.5),
        &["extract_materials", "extract_lights", "extract_shot", "materials", "lights"],
        &["materials", "lights"],
    ),
    ("environment", add_sky, &["extract_sky", "extract_shot"], &[]),
];

#[test]
fn a_turned_sky_makes_and_sends_no_table() {
    let mut engine = open();
    let pixels = vec![Vec3::ONE, Vec3::X, Vec3::Y, Vec3::Z];
    let image = Arc::new(EnvironmentMap { size: UVec2::new(2, 2), pixels });
    let map = |tint, turn| Environment::Map { image: image.clone(), strength: 1.0, tint, turn };
    let sky = map(Vec3::ONE, DMat3::IDENTITY);
    let (_, uploads) = after(&mut engine, |world| {
        world.spawn((Name::new("sky"), sky));
    });
    assert!(uploads.contains_key("sky") && uploads.contains_key("sky_cdf"), "{uploads:?}");
    let before = engine.film().unwrap();
    let turned = map(Vec3::ONE, DMat3::from_rotation_x(1.0));
    let (entered, uploads) = after(&mut engine, |world| change::<Environment>(world, |sky| *sky = turned.clone()));
    assert_eq!(entered, with(&["extract_shot", "extract_sky"], &FILM));
    assert_eq!(uploads.keys().copied().collect::<Vec<_>>(), ["params"], "{uploads:?}");
    assert_ne!(engine.film().unwrap().rgb, before.rgb);
    let tinted = map(Vec3::new(1.0, 0.5, 0.25), DMat3::from_rotation_x(1.0));
    let (_, uploads) = after(&mut engine, |world| change::<Environment>(world, |sky| *sky = tinted.clone()));
    assert!(uploads.contains_key("sky"), "{uploads:?}");
}

#[test]
fn a_sun_that_goes_around_sends_no_table() {
    let mut engine = open();
    let day = |azimuth, strength| {
        let (turbidity, ground) = (3.0, Vec3::splat(0.3));
        Environment::Daylight(Daylight { elevation: 40.0, azimuth, turbidity, ground, strength, sun_size: 0.533 })
    };
    after(&mut engine, |world| {
        world.spawn((Name::new("sky"), day(0.0, 1.0)));
    });
    let (_, uploads) = after(&mut engine, |world| change::<Environment>(world, |sky| *sky = day(90.0, 1.0)));
    assert_eq!(uploads.keys().copied().collect::<Vec<_>>(), ["params"], "{uploads:?}");
    let (_, uploads) = after(&mut engine, |world| change::<Environment>(world, |sky| *sky = day(90.0, 2.0)));
    assert!(uploads.contains_key("sky"), "{uploads:?}");
}

fn add_sky(world: &mut World) {
    world.spawn((Name::new("sky"), Environment::Constant(Vec3::splat(0.5))));
}

fn set_emission(world: &mut World, factor: f32) {
    for mut material in world.query::<&mut Material>().iter_mut(world) {
        if material.emission != Vec3::ZERO {
            material.emission *= factor;
        }
    }
}

#[test]
fn an_edit_enters_what_it_touches_and_no_more() {
    let mut engine = open();
    for (name, edit, extraction, buffers) in RESTARTS {
        let (entered, uploads) = after(&mut engine, edit);
        assert_eq!(entered, with(extraction, &FILM), "{name}");
        let mut expected: Vec<&str> = buffers.iter().copied().chain(["params"]).collect();
        expected.sort_unstable();
        assert_eq!(uploads.into_keys().collect::<Vec<_>>(), expected, "{name}");
    }
    let (entered, _) = after(&mut engine, |w| change::<Film>(w, |film| film.exposure += 1.0));
    assert_eq!(entered, with(&["extract_shot", "outdate_picture"], &["record_picture"]), "exposure");
    let (entered, _) = after(&mut engine, |w| change::<Render>(w, |render| render.spp += 2));
    let more = ["accumulate_batch", "plan_batch", "record_batch", "record_picture"];
    assert_eq!(entered, with(&["extract_policy", "extract_shot"], &more), "more samples");
}

#[test]
fn a_moved_mesh_sends_its_own_triangles() {
    let mut engine = open();
    let first = engine.edit(|world| {
        let mut meshes = world.query::<(&Name, &Geometry)>();
        let mut named: Vec<(String, usize)> =
            meshes.iter(world).map(|(name, mesh)| (name.to_string(), mesh.0.triangles.len())).collect();
        named.sort();
        named[0].1
    });
    let (entered, uploads) = after(&mut engine, |w| {
        change::<Transform>(w, |place| place.0 = DAffine3::from_translation(DVec3::new(0.0, 0.001, 0.0)) * place.0);
    });
    assert!(entered.contains(&"extract_meshes") && entered.contains(&"build_tree"), "{entered:?}");
    assert!(!entered.contains(&"extract_materials") && !entered.contains(&"extract_sky"), "{entered:?}");
    assert_eq!(uploads["triangles"], 48 * first as u64, "{uploads:?}");
}

#[test]
fn what_is_written_with_what_it_was_makes_nothing_anew() {
    let mut engine = open();
    let touches: [(&str, Edit); 5] = [
        ("material", |w| change::<Material>(w, |_| ())),
        ("camera", |w| change::<Camera>(w, |_| ())),
        ("transform", |w| change::<Transform>(w, |_| ())),
        ("film", |w| change::<Film>(w, |_| ())),
        ("energy", |w| change::<Render>(w, |render| render.energy = Energy::Preserve)),
    ];
    for (name, touch) in touches {
        let (entered, uploads) = after(&mut engine, touch);
        assert!(entered.iter().all(|system| system.starts_with("extract_")), "{name}: {entered:?}");
        assert!(uploads.is_empty(), "{name}: {uploads:?}");
    }
}

#[test]
fn a_relief_that_comes_and_goes_keeps_the_tree() {
    let mut engine = open();
    engine.edit(|world| {
        world.query::<&mut Geometry>().iter_mut(world).for_each(|mut geometry| {
            let plain = MeshData { normals: Vec::new(), normal_triangles: Vec::new(), ..(*geometry.0).clone() };
            geometry.0 = Arc::new(plain);
        });
    });
    finish(&mut engine);
    let relief = |world: &mut World, on: bool| {
        let picture = TextureImage { size: UVec2::ONE, texels: Texels::Rgba8(vec![[160, 128, 240, 255]]) };
        let texture = Texture::new(Arc::new(picture), Reading::Normal { flip_green: false });
        let texture = world.spawn((Name::new("bumps"), texture)).id();
        let materials: Vec<Entity> = world.query_filtered::<Entity, With<Material>>().iter(world).collect();
        let maps = Maps { relief: on.then_some(texture), ..Maps::default() };
        materials.into_iter().for_each(|entity| _ = world.entity_mut(entity).insert(maps));
    };
    for on in [true, false, true] {
        let (entered, sent) = after(&mut engine, |world| relief(world, on));
        assert!(engine.features().contains("relief") == on && entered.contains(&"begin_film"));
        assert!(!entered.contains(&"build_tree") && !sent.contains_key("triangles"), "{entered:?}, {sent:?}");
        assert!(sent.contains_key("shading") == on);
    }
}

#[test]
fn code_that_is_run_once_more_is_not_compiled_again() {
    let mut engine = open();
    let plain = engine.film().unwrap();
    let path = std::fs::read_to_string("shaders/passes/trace/path.wgsl").unwrap();
    let brighter = path.replace("(*state).radiance += light;", "(*state).radiance += 2.0 * light;");
    // What a path lends is doubled too.
    let brighter = brighter.replace("lent.radiance += lent_light;", "lent.radiance += 2.0 * lent_light;");
    assert!(path != brighter);
    let library = Library::shipped().with("passes/trace/path", &brighter);
    let before = engine.compiled();
    let other = engine.remake(library).unwrap();
    assert_eq!(since(&engine.compiled(), &before), Counts::from([("path", 1)]));

    let shipped = engine.run(other);
    let (entered, _) = after(&mut engine, |_| ());
    assert!(entered.contains(&"begin_film") && !entered.contains(&"build_tree"), "{entered:?}");
    let doubled = engine.film().unwrap();
    assert!((doubled.mean[0] / plain.mean[0] - 2.0).abs() < 1e-4);

    // Features by turns, in both: what was compiled stays.
    let bsdf = |engine: &mut Engine, on: bool| {
        let integrator = if on { Integrator::Bsdf } else { Integrator::Path };
        after(engine, |world| change(world, |render: &mut Render| render.integrator = integrator));
    };
    bsdf(&mut engine, true);
    let other = engine.run(shipped);
    finish(&mut engine);
    bsdf(&mut engine, false);
    assert_eq!(engine.film().unwrap().pixels, plain.pixels);
    let before = engine.compiled();
    let mut aside = Some(other);
    for _ in 0..3 {
        for on in [true, false] {
            bsdf(&mut engine, on);
        }
        aside = aside.map(|code| engine.run(code));
        finish(&mut engine);
    }
    assert_eq!(engine.compiled(), before);
    assert_eq!(engine.film().unwrap().rgb, doubled.rgb);
    assert!(engine.film_seconds() > 0.0 && engine.film_seconds() < engine.spent().trace);
}
