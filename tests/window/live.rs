//! An engine that is watched: the picture follows the film, and the film is the same.

use std::path::Path;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec2};
use lucerna::Engine;
use lucerna::components::{Camera, Film, Material, Render};
use lucerna::engine::Progress;
use lucerna::gpu::Fit;
use lucerna::passes::lattice::{COARSEST, corners};
use lucerna::scene;
use lucerna::shader::{Features, Library};

use crate::support;

fn engine() -> Engine {
    let mut description = scene::load(Path::new("assets/scenes/cornell-data.ron"), &[]).unwrap().description;
    description.film.size = UVec2::new(128, 96);
    description.render.spp = 4;
    Engine::open(support::gpu(), Library::shipped(), &description).unwrap()
}

fn displays(engine: &Engine) -> u64 {
    engine.dispatches().get("display").copied().unwrap_or(0)
}

#[test]
fn the_picture_is_shown_whenever_there_is_more_of_it_and_then_no_more() {
    let mut quiet = engine();
    while !quiet.step(Duration::from_nanos(1)).unwrap().finished {
        assert_eq!(displays(&quiet), 0);
    }
    let mut live = engine();
    live.set_live(true);
    // Nothing is known yet: a level of the first sample; then row by row, as so short a time asks for.
    let mut batches = [0; 2];
    loop {
        let (before, Progress { spp, finished, .. }) = (displays(&live), live.step(Duration::from_nanos(1)).unwrap());
        batches[usize::from(spp > 0)] += 1;
        // Once all pixels have a sample, each batch is seen.
        assert!(spp == 0 || displays(&live) == before + 1, "{spp} spp");
        if finished {
            break;
        }
    }
    let shown = displays(&live);
    let of_levels = shown - batches[1];
    assert!(batches[0] > 3 * of_levels && of_levels >= 2, "{batches:?} batches, {of_levels} levels");
    let still = live.step(Duration::from_millis(12)).unwrap();
    assert!(still.finished && still.dispatches == 0 && displays(&live) == shown);
    assert_eq!(live.film().unwrap(), quiet.film().unwrap());
}

/// The picture of a film with one sample a pixel, as it is seen while only the corners of a level have it.
fn spread(whole: &[[u8; 4]], size: UVec2, level: u32) -> Vec<[u8; 4]> {
    let shift = corners(level).shift;
    let corner = |i: u32| (UVec2::new(i % size.x, i / size.x) >> shift) << shift;
    (0..size.x * size.y).map(corner).map(|at| whole[(at.y * size.x + at.x) as usize]).collect()
}

#[test]
fn each_step_shows_one_state_of_the_scene_and_all_of_the_film() {
    let edits: [fn(&mut World); 4] = [
        |world| {
            let mut cameras = world.query::<&mut Camera>();
            cameras.iter_mut(world).for_each(|mut camera| camera.position.x += 0.2);
        },
        |world| {
            let mut films = world.query::<&mut Film>();
            films.iter_mut(world).for_each(|mut film| film.size = UVec2::new(131, 67));
        },
        |world| {
            let mut materials = world.query::<&mut Material>();
            materials.iter_mut(world).for_each(|mut material| material.diffuse *= 0.5);
        },
        |world| {
            let mut settings = world.query::<&mut Render>();
            settings.iter_mut(world).for_each(|mut render| render.max_depth = 2);
        },
    ];
    let mut live = engine();
    live.set_live(true);
    let budget = Duration::from_micros(300);
    (0..5).for_each(|_| _ = live.step(budget).unwrap());
    for edit in edits {
        // The state there is to be, at one sample a pixel.
        live.edit(edit);
        let mut scene = live.describe("edited");
        scene.render.spp = 1;
        let mut whole = Engine::open(support::gpu(), Library::shipped(), &scene).unwrap();
        while !whole.step(Duration::from_secs(1)).unwrap().finished {}
        let whole = whole.film().unwrap().picture;

        let mut levels = Vec::new();
        while live.samples().0 == 0 || levels.is_empty() {
            live.step(budget).unwrap();
            let (seen, size) = (live.picture().unwrap().unwrap(), live.window_size());
            let level = (0..=COARSEST).find(|level| spread(&whole, size, *level) == seen);
            levels.push(level.expect("a picture of another state, or of two"));
        }
        // Coarse at first, then never coarser, and fine at last.
        assert!(levels.is_sorted_by(|a, b| a >= b) && levels[0] > 2 && levels.ends_with(&[0]), "{levels:?}");
    }
}

#[test]
fn a_film_that_was_watched_for_a_while_is_the_same() {
    let mut quiet = engine();
    while !quiet.step(Duration::from_millis(100)).unwrap().finished {}
    // Watched or not in between, with sweeps of all kinds cut anywhere.
    let mut engine = engine();
    let mut steps = 0u32;
    loop {
        steps += 1;
        engine.set_live(steps % 7 < 5);
        if engine.step(Duration::from_micros(100 << (steps % 4))).unwrap().finished {
            break;
        }
    }
    assert!(steps > 20, "{steps} steps show nothing");
    assert_eq!(engine.film().unwrap(), quiet.film().unwrap());
    assert_eq!(engine.report().unwrap().samples, 4 * 128 * 96);
}

#[test]
fn the_shader_of_the_window_links() {
    for library in [Library::shipped(), Library::embedded()] {
        let linked =
            library.link("window/picture", &Features::new()).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!(linked.entries().collect::<Vec<_>>(), ["corner", "colour"]);
    }
}

#[test]
fn a_picture_lies_in_the_middle_of_the_window() {
    let (film, window) = (UVec2::new(100, 50), UVec2::new(400, 400));
    assert_eq!(Fit::Fill.place(film, window), (Vec2::ZERO, Vec2::splat(400.0)));
    assert_eq!(Fit::Letterbox.place(film, window), (Vec2::new(0.0, 100.0), Vec2::new(400.0, 200.0)));
    assert_eq!(Fit::Letterbox.place(UVec2::new(50, 100), window), (Vec2::new(100.0, 0.0), Vec2::new(200.0, 400.0)));
}
