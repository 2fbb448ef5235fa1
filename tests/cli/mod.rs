//! The command line, by running it: exit codes, one message a mistake, and files that are whole.

mod edits;
mod errors;
mod export;
mod help;
mod new;
#[cfg(unix)]
mod no_files;
mod outputs;
mod progress;
mod quality;
mod refusals;
mod render;
mod replay;
mod shaders;
#[cfg(unix)]
mod signals;
mod stress;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// Runs the binary in a folder.
fn lucerna(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    // Where there is a display, `lucerna` alone would open a window.
    for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(display);
    }
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap()
}

/// What a failed run printed to stderr, after checks that hold for every failure.
fn refused(code: i32, folder: &Path, arguments: &[&str]) -> String {
    let run = lucerna(folder, arguments);
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(code), "{arguments:?} said:\n{text}");
    assert!(!text.contains("panicked") && !text.contains("RUST_BACKTRACE"), "{arguments:?} said:\n{text}");
    let errors = text.matches("error:").count();
    assert_eq!(errors, 1, "{arguments:?} has not exactly one message:\n{text}");
    assert!(run.stdout.is_empty(), "{arguments:?} wrote to stdout");
    text
}

const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (20, 12)),
    render: (spp: 2, max_depth: 3),
    environment: Constant((1, 1, 1)),
    materials: { "grey": (kd: (0.5, 0.5, 0.5)) },
)
"#;
const OBJ: &str = "mtllib a.mtl\no thing\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\n";

/// A folder with a small scene, of which one file may be another.
fn folder_with(name: &str, content: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (file, text) in [("a.ron", SCENE), ("a.obj", OBJ), ("a.mtl", MTL)] {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    if !name.is_empty() {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// The report of a render of the small scene.
fn rendered(folder: &Path, more: &[&str]) -> Value {
    let mut arguments = vec!["render", "a.ron", "--quiet", "--json"];
    arguments.extend(more);
    let run = lucerna(folder, &arguments);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{arguments:?} said:\n{said}");
    serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {:?}", run.stdout))
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn help_says_what_there_is() {
    for (arguments, code) in [(&["--help"][..], 0), (&["--version"], 0), (&["render", "--help"], 0), (&[], 2)] {
        assert_eq!(lucerna(Path::new("."), arguments).status.code(), Some(code), "{arguments:?}");
    }
    let help = String::from_utf8(lucerna(Path::new("."), &["--help"]).stdout).unwrap();
    for word in ["view", "render", "new", "check", "doctor", "bench", "judge", "watch", "help exit-codes"] {
        assert!(help.contains(word), "--help lacks {word}");
    }
}

#[test]
fn check_reads_assets_and_links_every_pass() {
    let folder = folder_with("", b"");
    let run = lucerna(folder.path(), &["check", "."]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(String::from_utf8(run.stdout).unwrap().starts_with("3 assets: 0 errors, 0 warnings"));
    std::fs::write(folder.path().join("a.ron"), "(film: 3)").unwrap();
    let run = lucerna(folder.path(), &["check", "."]);
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8(run.stderr).unwrap().contains("a.ron:1:"));

    let run = lucerna(Path::new(env!("CARGO_MANIFEST_DIR")), &["check"]);
    let (out, said) = (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap());
    assert_eq!(run.status.code(), Some(0), "{out}{said}");
    assert!(out.contains("passes"), "{out}");
    // The dining room's materials are written as exporters do; its scenes tune them.
    let mut warnings = said.lines().filter(|line| line.contains("warning: ") || line.contains("error: "));
    let is_known = |line: &str| line.contains("dining-room.mtl") && line.contains("beside `map_Kd`");
    assert!(warnings.all(is_known), "our own assets are without a fault:\n{out}{said}");
}

#[test]
fn check_prints_a_table_of_materials() {
    let folder = folder_with("a.mtl", b"newmtl grey\nKd 0.6 0.6 0.6\nillum 4\nTf 1 1 1\nNi 1\n");
    let run = lucerna(folder.path(), &["check", "a.obj"]);
    let out = String::from_utf8(run.stdout).unwrap();
    assert!(
        out.starts_with("1 asset: 0 errors, 1 warning\n\na.obj\n  grey  diffuse  Kd 0.6 0.6 0.6; illum 4 alone"),
        "{out}"
    );
}

#[test]
fn doctor_names_the_adapter_that_is_used() {
    let run = lucerna(Path::new("."), &["doctor"]);
    let out = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{out}");
    assert!(out.contains("ready: renders use") && out.contains("driver:"), "{out}");
}

#[test]
fn an_adapter_that_is_none_is_refused_and_an_empty_one_is_not_asked_for() {
    let doctor = |adapter: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        command.arg("doctor").env("LUCERNA_ADAPTER", adapter).output().unwrap()
    };
    let first = doctor("0");
    assert!(first.status.success());
    for empty in ["", " ", "\t", " 0 "] {
        let run = doctor(empty);
        assert_eq!((run.status.code(), run.stdout), (Some(0), first.stdout.clone()), "{empty:?}");
    }
    let listed = String::from_utf8(first.stdout).unwrap();
    let name = listed.lines().find_map(|line| line.strip_prefix("* 0: ")).unwrap().split(" (").next().unwrap();
    for wrong in ["99", "-1", "0.0", "llvmpipe", "0,1", "99999999999999999999"] {
        let run = doctor(wrong);
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(3), "{wrong}: {said}");
        assert!(said.contains(&format!("LUCERNA_ADAPTER is `{wrong}`")) && said.contains(name), "{wrong}: {said}");
        assert_eq!(said.matches("error:").count(), 1, "{said}");
    }
}

#[test]
fn a_reader_that_has_gone_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["check", "assets/scenes/teapot.ron"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && !said.contains("panicked"), "{:?}: {said}", run.status);
}
