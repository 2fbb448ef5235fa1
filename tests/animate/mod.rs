//! Scenes that change with time: their keys, the frames that they come to, and the film of these.

mod between;
mod extended;
mod frames;
mod movie;
mod readme;
mod resume;
mod wrong;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use lucerna::app::variants::record::Answer;
use lucerna::scene::variants::{Family, frames};
use lucerna::scene::{Assets, Diagnostics};
use tempfile::TempDir;

use crate::support::families;

const OBJ: &str = "mtllib a.mtl\no thing\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\nKs 0.2 0.2 0.2\nNs 20\n";

/// A small scene with this under `animate`, on the fourth line.
fn scene(animate: &str) -> String {
    format!(
        r#"(
    models: [(path: "a.obj", name: "thing")],
    cameras: {{ "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40), "near": (position: (0, 0, 2), look_at: (0, 0, 0)) }},
    animate: {animate},
    camera: "front", film: (size: (21, 13)), render: (spp: 4, max_depth: 3), environment: Constant((1, 1, 1)),
)
"#
    )
}

/// A folder with files, and the model that the scenes here have.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (file, text) in [("a.obj", OBJ), ("a.mtl", MTL)].iter().chain(files) {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    folder
}

/// The frames of a scene in the folder.
fn planned(folder: &Path, file: &str) -> Result<Option<Family>, Diagnostics> {
    frames(&folder.join(file), &[], &Assets::new())
}

/// What a path is at each frame of `animate: (frames: .., keys: { path: values })`, as it is written.
fn written(count: u32, path: &str, values: &str) -> Vec<String> {
    let folder = folder(&[("a.ron", &scene(&format!("(frames: {count}, keys: {{ \"{path}\": {values} }})")))]);
    let family = planned(folder.path(), "a.ron").unwrap_or_else(|found| panic!("{values}: {found:?}")).unwrap();
    assert_eq!(family.members.len(), count as usize);
    family.members.iter().map(|member| member.defines[0].value.clone()).collect()
}

/// The same of a number.
fn numbers(count: u32, values: &str) -> Vec<f64> {
    written(count, "film.exposure", values).iter().map(|value| value.parse().unwrap()).collect()
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    // No film is made by what may be installed.
    command.args(["animate", "a.ron"]).args(arguments).current_dir(folder).env("PATH", folder).stdin(Stdio::null());
    command
}

/// Runs the command to its end.
fn run(folder: &Path, arguments: &[&str]) -> Output {
    families::run(command(folder, arguments))
}

/// The same with `--json --quiet`, which is to end with a code.
fn answer(folder: &Path, arguments: &[&str], code: i32) -> Answer {
    families::answer(command(folder, arguments), code)
}
