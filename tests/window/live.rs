//! An engine that is watched: the picture follows the film, and the film is the same.

use std::path::Path;
use std::time::Duration;

use glam::{UVec2, Vec2};
use lucerna::Engine;
use lucerna::gpu::Fit;
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
fn the_picture_is_shown_after_every_batch_and_then_no_more() {
    let mut quiet = engine();
    while !quiet.step(Duration::from_nanos(1)).unwrap().finished {
        assert_eq!(displays(&quiet), 0);
    }
    let mut live = engine();
    live.set_live(true);
    let mut batches = 0;
    while !live.step(Duration::from_nanos(1)).unwrap().finished {
        batches += 1;
        assert_eq!(displays(&live), batches);
    }
    // The first batch is of two samples, as nothing is known yet; those after it are of rows, as so short a time asks for.
    assert!(batches > 2, "{batches} batches do not show that any follows another");
    let shown = displays(&live);
    let still = live.step(Duration::from_millis(12)).unwrap();
    assert!(still.finished && still.dispatches == 0 && displays(&live) == shown);
    assert_eq!(live.film().unwrap(), quiet.film().unwrap());
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
