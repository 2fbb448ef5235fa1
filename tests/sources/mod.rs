//! Where the error comes from: what rays bring is the twin's, its parts add up to the film's own error, and of scenes whose answer is known it is
//! that.

mod film;
mod known;
mod shares;
mod totals;
mod twin;

use std::path::Path;
use std::time::Duration;

use lucerna::Engine;
use lucerna::engine::{ErrorSources, Survey, Surveyed};
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;

use crate::support;

/// Paths of a window: so many that small films have several.
const MOST_PATHS: u64 = 1 << 13;

/// A shipped scene, and what is set over it.
fn scene_with(name: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    load(&path, defines)
}

fn load(path: &Path, defines: &[(&str, &str)]) -> SceneDescription {
    let defines: Vec<_> = defines.iter().map(|(path, value)| scene::Define::given(*path, *value)).collect();
    scene::load(path, &defines).unwrap_or_else(|errors| panic!("{errors}")).description
}

/// An engine whose film is finished.
fn open(description: &SceneDescription) -> Engine {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), description).unwrap();
    while !engine.step(Duration::from_secs(5)).unwrap().finished {}
    engine
}

/// All of a survey.
fn surveyed(engine: &mut Engine) -> (Survey, ErrorSources) {
    let mut survey = engine.begin_survey(MOST_PATHS).unwrap().expect("a film");
    let mut windows = 1;
    while engine.survey(&mut survey).unwrap() == Surveyed::More {
        windows += 1;
    }
    assert!(survey.done() == 1.0 && windows > 1, "{windows} windows");
    let sources = engine.sources(&survey);
    (survey, sources)
}
