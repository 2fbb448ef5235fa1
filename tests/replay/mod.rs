//! A sample traced again, ray by ray: the kernel's numbers are the twin's but for rounding, and what is said of it is what the film got.

mod film;
mod judged;
mod kept;
mod oracle;

use std::path::Path;
use std::time::Duration;

use glam::UVec2;
use lucerna::Engine;
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;

use crate::support;

/// Pixels of the film.
const SIZE: UVec2 = UVec2::new(24, 18);

/// A shipped scene of a small film, and what is set over it.
fn scene_with(name: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let small = [("film.size", "(24, 18)"), ("render.spp", "1")];
    let defines: Vec<_> =
        small.iter().chain(defines).map(|(path, value)| scene::Define::given(*path, *value)).collect();
    scene::load(&path, &defines).unwrap_or_else(|errors| panic!("{errors}")).description
}

/// An engine that has traced a sample a pixel.
fn open(library: Library, description: &SceneDescription) -> Engine {
    let mut engine = Engine::open(support::gpu(), library, description).unwrap();
    while !engine.step(Duration::from_secs(5)).unwrap().finished {}
    engine
}
