//! Numbers that code shows of itself: how they are linked, and where they are heard.

mod linked;
mod replayed;
mod shown;

use std::path::Path;
use std::time::Duration;

use lucerna::Engine;
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

/// The shipped shaders with changes of the path kernel: each finds what it looks for.
fn path_with(changes: &[(&str, &str)]) -> Library {
    let library = Library::shipped();
    let text = library.text("passes/trace/path").unwrap().to_owned();
    let text = changes.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "nothing of `{from}`");
        text.replace(from, to)
    });
    library.with("passes/trace/path", &text)
}

/// Opens a shipped scene with what is set over it, and traces it to its end.
fn open(library: Library, name: &str, defines: &[(&str, &str)]) -> Engine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let defines: Vec<_> = defines.iter().map(|(path, value)| scene::Define::given(*path, *value)).collect();
    let description = scene::load(&path, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
    let mut engine = Engine::open(support::gpu(), library, &description).unwrap();
    finish(&mut engine);
    engine
}

fn finish(engine: &mut Engine) {
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
}
