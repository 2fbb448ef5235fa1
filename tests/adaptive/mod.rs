//! Adaptive films: how samples are dealt, what the passes do, and films as a whole.

mod converged;
mod dealt;
mod error;
mod films;
mod gain;
mod passes;
mod rounds;

use std::path::Path;
use std::time::Duration;

use lucerna::components::{Adaptive, Render};
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;
use lucerna::{Engine, FilmImage};

use crate::support;

pub const LONG: Duration = Duration::from_secs(10);

/// A scene that is shipped, adaptive, with other changes.
fn describe(name: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let all = [&[("film.size", "(45,27)"), ("render.adaptive", "On"), ("render.reuse", "Off")], defines].concat();
    let defines: Vec<_> = all.iter().map(|(path, value)| scene::Define::given(*path, *value)).collect();
    scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description
}

fn open(description: &SceneDescription) -> Engine {
    Engine::open(support::gpu(), Library::shipped(), description).unwrap()
}

fn finish(engine: &mut Engine, step: Duration) -> FilmImage {
    while !engine.step(step).unwrap().finished {}
    engine.film().unwrap()
}

/// Writes other settings, and traces.
fn trace(engine: &mut Engine, change: impl Fn(&mut Render)) -> FilmImage {
    engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| change(&mut render)));
    finish(engine, Duration::from_millis(500))
}

fn plain(description: &SceneDescription) -> SceneDescription {
    let render = Render { adaptive: Adaptive::Off, ..description.render };
    SceneDescription { render, ..description.clone() }
}
