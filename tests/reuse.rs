//! Films whose paths are reused within tiles: the same however they were cut, watched or come by.

use std::path::Path;
use std::time::Duration;

use glam::UVec2;
use lucerna::Engine;
use lucerna::components::{Camera, Crop, Render, Reuse};
use lucerna::engine::Report;
use lucerna::layout::film::FilmPixel;
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;

use crate::support;

const LONG: Duration = Duration::from_secs(10);

/// More pixels than a first batch has samples, so that who watches gets a level of them.
const LARGE: &[(&str, &str)] = &[("film.size", "(90,70)"), ("render.spp", "3")];

/// A step of the smallest batch, once the governor has learnt what one takes.
const SHORT: Duration = Duration::from_nanos(1);

fn describe(name: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let all = [&[("film.size", "(45,27)"), ("render.reuse", "Tiles")], defines].concat();
    let defines: Vec<_> = all.iter().map(|(path, value)| scene::Define::given(*path, *value)).collect();
    scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description
}

fn open(description: &SceneDescription) -> Engine {
    Engine::open(support::gpu(), Library::shipped(), description).unwrap()
}

fn finish(engine: &mut Engine, step: Duration) -> Vec<FilmPixel> {
    while !engine.step(step).unwrap().finished {}
    engine.film().unwrap().pixels
}

/// Counts of the film alone, whatever it took to get there.
fn counts(engine: &mut Engine) -> (u64, u64, u64) {
    let Report { samples, rays, bad_samples, .. } = engine.report().unwrap();
    (samples, rays, bad_samples)
}

#[test]
fn a_film_does_not_depend_on_how_its_samples_were_cut() {
    for name in ["cornell-box", "teapot"] {
        let description = describe(name, &[("render.spp", "12")]);
        let mut engine = open(&description);
        let whole = finish(&mut engine, LONG);
        assert!(engine.features().contains("reuse"));
        let counted = counts(&mut engine);
        let mut engine = open(&description);
        assert!(finish(&mut engine, SHORT) == whole, "{name}: block row by block row");
        assert_eq!(counts(&mut engine), counted, "{name}");
        let mut engine = open(&describe(name, &[("render.spp", "3")]));
        for spp in [3, 8, 12] {
            engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.spp = spp));
            finish(&mut engine, LONG);
        }
        assert!(engine.film().unwrap().pixels == whole, "{name}: resumed twice");
        let own = finish(&mut open(&describe(name, &[("render.spp", "12"), ("render.reuse", "Off")])), LONG);
        assert!(own != whole, "{name}: nothing is reused");
    }
}

#[test]
fn a_crop_equals_the_crop_of_the_whole() {
    for name in ["cornell-box", "teapot"] {
        let mut description = describe(name, &[("render.spp", "4")]);
        let whole = finish(&mut open(&description), LONG);
        for (min, max) in [(UVec2::new(5, 9), UVec2::new(30, 22)), (UVec2::new(41, 1), UVec2::new(45, 27))] {
            description.film.crop = Some(Crop { min, max });
            let rows = (min.y..max.y).map(|y| &whole[(y * 45 + min.x) as usize..(y * 45 + max.x) as usize]);
            let right: Vec<FilmPixel> = rows.flatten().copied().collect();
            for step in [LONG, SHORT] {
                assert!(finish(&mut open(&description), step) == right, "{name}, {min} to {max}");
            }
        }
    }
}

#[test]
fn who_watches_gets_the_same_film() {
    let description = describe("cornell-box", LARGE);
    let mut fresh = open(&description);
    let right = finish(&mut fresh, LONG);
    let mut engine = open(&description);
    engine.set_live(true);
    let mut seen_without_samples = 0;
    loop {
        let progress = engine.step(SHORT).unwrap();
        let film = engine.film().unwrap();
        let dark = film.pixels.iter().filter(|pixel| pixel.halves[0].count + pixel.halves[1].count == 0).count();
        let picture = engine.picture().unwrap().expect("whoever watches sees a picture from the first step on");
        assert!(picture.iter().filter(|p| p[0] > 0).count() > picture.len() / 2, "the picture went dark");
        seen_without_samples += u32::from(progress.spp == 0 && dark == 0);
        if progress.finished {
            break;
        }
    }
    assert!(seen_without_samples > 1, "no sample was replaced");
    assert!(engine.film().unwrap().pixels == right);
    assert_eq!(counts(&mut engine), counts(&mut fresh), "a preview's samples are none of the film");
}

#[test]
fn edits_end_where_a_fresh_engine_begins() {
    let mut engine = open(&describe("cornell-box", LARGE));
    engine.set_live(true);
    for round in 0..6 {
        for _ in 0..round {
            engine.step(SHORT).unwrap();
        }
        engine.edit(|world| {
            world.query::<&mut Camera>().iter_mut(world).for_each(|mut camera| camera.position.x += 0.1);
            let reuse = if round % 3 == 2 { Reuse::Off } else { Reuse::Tiles };
            world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.reuse = reuse);
        });
        engine.set_live(round % 2 == 0);
    }
    let fresh = open(&engine.describe("edited"));
    let [edited, fresh] = [engine, fresh].map(|mut engine| finish(&mut engine, SHORT));
    assert!(edited == fresh);
}

#[test]
fn nothing_of_it_runs_where_it_can_do_nothing() {
    let passes = |defines: &[(&str, &str)]| {
        let mut engine = open(&describe("cornell-box", &[&[("render.spp", "1")], defines].concat()));
        finish(&mut engine, LONG);
        (engine.dispatches().contains_key("gather"), engine.features().contains("reuse"))
    };
    assert_eq!(passes(&[]), (true, true));
    assert_eq!(passes(&[("render.reuse", "Off")]), (false, false));
    assert_eq!(passes(&[("render.integrator", "Bsdf")]), (false, false), "integrator Bsdf");
    assert_eq!(passes(&[("render.max_depth", "2")]), (false, false), "paths that have no second surface to go on from");
}
