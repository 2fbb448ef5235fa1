//! Commands that render families of scenes, run to their end.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use lucerna::Engine;
use lucerna::app::variants::record::{Answer, State};
use lucerna::scene::{self, Define};
use lucerna::shader::Library;

/// Runs a command, which is not to panic.
pub fn run(mut command: Command) -> Output {
    let run = command.output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!said.contains("panicked"), "{command:?}: {said}");
    run
}

/// The same with `--json --quiet`, which is to end with a code.
pub fn answer(mut command: Command, code: i32) -> Answer {
    command.args(["--json", "--quiet"]);
    let asked = format!("{command:?}");
    let run = run(command);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(code), "{asked}: {said}");
    serde_json::from_slice(&run.stdout).unwrap()
}

/// Names of the members that are done.
pub fn done(answer: &Answer) -> Vec<&str> {
    let done = answer.records.iter().filter(|record| record.state == State::Done);
    done.map(|record| record.name.as_str()).collect()
}

/// The pixels of a scene that is rendered alone, as bits.
pub fn alone(scene: &Path, defines: &[Define]) -> Vec<u32> {
    let description = scene::load(scene, defines).unwrap().description;
    let mut engine = Engine::open(super::gpu(), Library::embedded(), &description).unwrap();
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
    bits(&engine.film().unwrap().rgb)
}

pub fn bits(rgb: &[[f32; 3]]) -> Vec<u32> {
    rgb.as_flattened().iter().map(|channel| channel.to_bits()).collect()
}
