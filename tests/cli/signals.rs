//! The first signal ends a process within a second, at whatever it is.

use std::fmt::Write;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use super::{MTL, SCENE, folder_with};
use crate::support::patience::time_to_end;

/// A second, and what a busy machine takes to end a process.
const SOON: Duration = Duration::from_millis(2500);

fn tell(child: &Child, signal: &str) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

/// Starts the binary, tells it to end after `delay`, and returns its exit code; None where the signal itself ended it.
#[track_caller]
fn ended_by(folder: &Path, arguments: &[&str], delay: Duration, signal: &str) -> Option<i32> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    std::thread::sleep(delay);
    assert!(child.try_wait().unwrap().is_none(), "{arguments:?} was over before it was told to end");
    tell(&child, signal);
    if time_to_end(&mut child, SOON).is_none() {
        let _ = child.kill();
        let _ = child.wait();
        panic!("{arguments:?} goes on {SOON:?} after {signal}, sent after {delay:?}");
    }
    child.wait().unwrap().code()
}

/// A model that takes longer to read than the signal waits: nearly as many triangles as lavapipe has buffers for.
fn large_model() -> String {
    let mut text = String::from("mtllib a.mtl\nusemtl grey\n");
    for i in 0..2_000_000u32 {
        let [x, y, z] = [i % 97, i % 89, i % 83].map(|n| f64::from(n) * 0.125);
        writeln!(text, "v {x} {y} {z}\nf -1 -{} -{}", i % 7 + 1, i % 5 + 1).unwrap();
    }
    text
}

#[test]
fn the_first_signal_ends_it_while_it_reads() {
    let folder = folder_with("a.obj", large_model().as_bytes());
    let commands: [(&[&str], i32); 5] = [
        (&["render", "a.ron"], 130),
        (&["watch", "a.ron"], 0),
        (&["judge", "a.ron", "--new", "."], 130),
        (&["bench", "./a.ron"], 130),
        (&["check", "a.ron"], 130),
    ];
    for (arguments, code) in commands {
        for signal in ["-INT", "-TERM"] {
            let ended = ended_by(folder.path(), arguments, Duration::from_millis(100), signal);
            // A check that was all but over when the signal came may end with what it found.
            let all_but_over = arguments[0] == "check" && ended == Some(0);
            assert!(all_but_over || ended.is_none_or(|ended| ended == code), "{arguments:?}, {signal}: {ended:?}");
        }
    }
    assert!(!folder.path().join("result").join("a.png").exists());
}

/// Films of independent samples, and a difference that so many of them would not find: only the signal ends it.
#[test]
fn the_first_signal_ends_a_judge_that_traces() {
    let folder = folder_with("a.ron", SCENE.replace("spp: 2", "sampler: Pcg, spp: 2").as_bytes());
    let root = folder.path().join("shaders");
    crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &root);
    let arguments =
        ["judge", "a.ron", "--new", "shaders", "--force", "--films", "10000000", "--within", "0.001", "--quiet"];
    let ended = ended_by(folder.path(), &arguments, Duration::from_secs(4), "-INT");
    assert!(ended.is_none_or(|ended| ended == 130), "{ended:?}");
}

/// Devices are opened, and kernels compiled, one after the other: at some of these moments the driver is at it.
#[test]
fn the_first_signal_ends_it_while_it_starts() {
    let folder = folder_with("a.mtl", MTL.as_bytes());
    // A kernel that nothing has compiled before, since its text is another.
    let root = folder.path().join("shaders");
    crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &root);
    let file = root.join("lib/sampling.wgsl");
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(
        folder.path().join("a.ron"),
        SCENE.replace("(20, 12)", "(200, 120)").replace("spp: 2", "spp: 60000"),
    )
    .unwrap();
    for (i, delay) in [50, 150, 300, 600, 1200, 2400, 4800].into_iter().enumerate() {
        let scale = format!("return Angle(0.{}1 * sqrt(1.0 - u)", std::process::id() + i as u32);
        let other = text.replace("return Angle(sqrt(1.0 - u)", &scale);
        assert_ne!(other, text);
        std::fs::write(&file, other).unwrap();
        for command in ["render", "watch"] {
            let ended = ended_by(folder.path(), &[command, "a.ron"], Duration::from_millis(delay), "-INT");
            assert!(ended.is_none_or(|ended| [0, 130].contains(&ended)), "{command} after {delay} ms: {ended:?}");
        }
    }
}
