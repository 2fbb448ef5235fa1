//! Families of scenes: their files, the command that renders them, and its answers.

#[cfg(unix)]
mod browser;
mod compete;
mod files;
mod goals;
mod hand;
#[cfg(unix)]
mod page;
mod planning;
mod race;
mod resume;
mod share;
mod sheet;
mod table;
mod wrong;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use lucerna::app::variants::record::{Answer, Record};
use tempfile::TempDir;

use crate::support::families;

const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: {
        "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40),
        "left": (position: (-1, 0.5, 3), look_at: (0, 0, 0), fov_y: 40),
        "near": (position: (0.2, 0, 2), look_at: (0, 0, 0), fov_y: 40),
    },
    film: (size: (20, 12)),
    render: (spp: 4, max_depth: 3),
    environment: Constant((1, 1, 1)),
    materials: { "grey": (kd: (0.5, 0.5, 0.5)) },
)
"#;
const OBJ: &str = "mtllib a.mtl\no thing\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\nKs 0.2 0.2 0.2\nNs 20\n";

/// A folder with a small scene, and a family of it.
fn folder(family: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (file, text) in [("a.ron", SCENE), ("a.obj", OBJ), ("a.mtl", MTL), ("fam.ron", family)] {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.arg("variants").arg("fam.ron").args(arguments).current_dir(folder).stdin(Stdio::null());
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

fn member<'a>(answer: &'a Answer, name: &str) -> &'a Record {
    answer.records.iter().find(|record| record.name == name).unwrap()
}
