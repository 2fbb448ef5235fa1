//! The engine as a whole: the same film however it was come by, and no work that nothing asked for.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec3};
use lucerna::components::{Camera, Crop, Environment, Film, Material, Render, Transform};
use lucerna::engine::TreeBuilder;
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;
use lucerna::{Engine, EngineError, FilmImage};

use crate::support;

const STEP: Duration = Duration::from_millis(100);

fn describe(name: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let defines: Vec<_> = defines.iter().map(|(path, value)| scene::Define::given(*path, *value)).collect();
    scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description
}

fn open(description: &SceneDescription) -> Engine {
    Engine::open(support::gpu(), Library::shipped(), description).unwrap()
}

fn finish(engine: &mut Engine, step: Duration) -> FilmImage {
    while !engine.step(step).unwrap().finished {}
    let film = engine.film().unwrap();
    assert_eq!(engine.radiance().unwrap(), film.rgb);
    film
}

/// A small Cornell box: the film is checked to the bit, so its size does not matter.
fn small_box(spp: &str) -> SceneDescription {
    describe("cornell-box", &[("film.size", "(40,24)"), ("render.spp", spp)])
}

/// The sums of a film, bit for bit.
fn sums(engine: &mut Engine, step: Duration) -> Vec<lucerna::layout::film::FilmPixel> {
    finish(engine, step).pixels
}

#[test]
fn a_film_does_not_depend_on_how_its_samples_were_cut() {
    for name in ["cornell-box", "teapot"] {
        let of = |spp: &str, seed: &str| {
            describe(name, &[("film.size", "(40,24)"), ("render.spp", spp), ("render.seed", seed)])
        };
        let description = of("64", "0");
        let whole = sums(&mut open(&description), Duration::from_secs(10));
        assert!(whole.iter().any(|p| p.halves[0].sum[0].x != 0), "a black film proves nothing");
        assert_eq!(sums(&mut open(&description), Duration::from_secs(10)), whole, "{name}: the same seed twice");
        // A nanosecond is a row of one sample at a time, once the governor has learnt what a row takes.
        assert_eq!(sums(&mut open(&description), Duration::from_nanos(1)), whole, "{name}: row by row");
        let mut engine = open(&of("16", "0"));
        for spp in [16, 32, 48, 64] {
            engine.edit(|world| change::<Render>(world, |render| render.spp = spp));
            finish(&mut engine, STEP);
        }
        assert_eq!(engine.film().unwrap().pixels, whole, "{name}: four times 16 samples on one engine");
        assert_ne!(sums(&mut open(&of("64", "1")), STEP), whole, "{name}: another seed");
    }
}

#[test]
fn a_crop_equals_the_crop_of_the_whole() {
    for name in ["cornell-box", "teapot"] {
        let mut description = describe(name, &[("film.size", "(36,28)"), ("render.spp", "4")]);
        let whole = sums(&mut open(&description), STEP);
        let (min, max) = (UVec2::new(5, 9), UVec2::new(30, 22));
        description.film.crop = Some(Crop { min, max });
        let part = sums(&mut open(&description), STEP);
        let rows = (min.y..max.y).map(|y| &whole[(y * 36 + min.x) as usize..(y * 36 + max.x) as usize]);
        assert_eq!(part, rows.flatten().copied().collect::<Vec<_>>(), "{name}");
    }
}

/// Dispatches by pass since the last look.
fn news(engine: &Engine, seen: &mut BTreeMap<&'static str, u64>) -> BTreeMap<&'static str, u64> {
    let now = engine.dispatches().clone();
    let since = now.iter().map(|(pass, n)| (*pass, n - seen.get(pass).unwrap_or(&0))).filter(|(_, n)| *n > 0).collect();
    *seen = now;
    since
}

/// One step of one sample after an edit: which passes ran.
fn passes_after(
    engine: &mut Engine,
    seen: &mut BTreeMap<&'static str, u64>,
    edit: impl FnOnce(&mut World),
) -> Vec<&'static str> {
    engine.edit(edit);
    finish(engine, Duration::from_secs(10));
    news(engine, seen).into_keys().collect()
}

fn change<C: Component<Mutability = bevy_ecs::component::Mutable>>(world: &mut World, what: impl Fn(&mut C)) {
    let mut entities = world.query::<(&Name, &mut C)>();
    let first = entities.iter(world).map(|(name, _)| name.to_string()).min().unwrap();
    for (name, mut component) in entities.iter_mut(world) {
        if name.as_str() == first {
            what(&mut component);
        }
    }
}

#[test]
fn only_what_an_edit_touches_runs_again() {
    let mut engine = open(&small_box("2"));
    engine.set_tree_builder(TreeBuilder::Passes);
    let mut seen = BTreeMap::new();
    finish(&mut engine, Duration::from_secs(10));
    let first: Vec<_> = news(&engine, &mut seen).into_keys().collect();
    let tree = ["bounds", "leaves", "morton", "nodes", "pyramid"];
    assert!(tree.iter().all(|pass| first.contains(pass)), "{first:?}");

    for _ in 0..3 {
        assert_eq!(engine.step(STEP).unwrap().dispatches, 0, "a finished film of an unchanged scene");
    }
    let light = vec!["accumulate", "display", "gather", "path"];
    let none: Vec<&str> = vec![];
    let mut after = |edit: fn(&mut World)| passes_after(&mut engine, &mut seen, edit);
    assert_eq!(after(|w| change::<Film>(w, |f| f.exposure += 1.0)), ["display"], "exposure");
    assert_eq!(after(|w| change::<Camera>(w, |c| c.position.x += 0.1)), light, "camera");
    assert_eq!(after(|w| change::<Material>(w, |m| m.diffuse *= 0.9)), light, "a material's numbers");
    assert_eq!(after(|w| change::<Render>(w, |r| r.seed += 1)), light, "seed");
    assert_eq!(after(|w| change::<Film>(w, |f| f.size.x += 1)), light, "film size");
    assert_eq!(after(|w| change::<Render>(w, |r| r.spp += 2)), light, "more samples");
    assert_eq!(after(|w| change::<Render>(w, |r| r.spp -= 2)), light, "fewer samples");
    assert_eq!(after(|w| change::<Material>(w, |m| m.diffuse *= 1.0)), none, "a material written with what it was");
    assert_eq!(after(|w| change::<Camera>(w, |c| c.fov_y += 0.0)), none, "a camera written with what it was");
    assert_eq!(after(|w| change::<Transform>(w, |_| ())), none, "a transform written with what it was");
    let moved = after(|w| change::<Transform>(w, |t| t.0.translation.y += 0.01));
    assert!(tree.iter().all(|pass| moved.contains(pass)) && moved.contains(&"path"), "a transform: {moved:?}");
}

#[test]
fn what_a_scene_lacks_is_not_compiled() {
    let mut description = small_box("1");
    for material in description.materials.values_mut() {
        material.ks = Vec3::ZERO;
    }
    let mut engine = open(&description);
    finish(&mut engine, STEP);
    let features = |engine: &Engine| engine.features().clone();
    let plain = features(&engine);
    assert!(!plain.contains("phong") && !plain.contains("environment"), "{plain:?}");
    engine.edit(|world| {
        world.spawn((Name::new("sky"), Environment::Constant(Vec3::ONE)));
        change::<Material>(world, |m| m.specular = Vec3::splat(0.1));
    });
    finish(&mut engine, STEP);
    let rich = features(&engine);
    assert!(rich.contains("phong") && rich.contains("environment"), "{rich:?}");
}

#[test]
fn a_scene_with_two_films_says_so_and_recovers() {
    let mut engine = open(&small_box("1"));
    let second = engine.edit(|world| world.spawn((Film::default(), Render::default())).id());
    assert!(matches!(engine.step(STEP), Err(EngineError::ManyFilms)));
    engine.edit(|world| world.despawn(second));
    let film = finish(&mut engine, STEP);
    assert_eq!(film.pixels, sums(&mut open(&small_box("1")), STEP));
}

#[test]
fn a_scene_without_a_camera_says_so_and_recovers() {
    let mut engine = open(&small_box("1"));
    let cameras: Vec<(Entity, Camera)> =
        engine.edit(|world| world.query::<(Entity, &Camera)>().iter(world).map(|(e, c)| (e, *c)).collect());
    engine.edit(|world| {
        for (entity, _) in &cameras {
            world.despawn(*entity);
        }
    });
    assert!(matches!(engine.step(STEP), Err(EngineError::NoCamera)));
    engine.edit(|world| world.spawn((Name::new("front"), cameras[0].1)).id());
    let film = finish(&mut engine, STEP);
    assert_eq!(film.pixels, sums(&mut open(&small_box("1")), STEP));
}
