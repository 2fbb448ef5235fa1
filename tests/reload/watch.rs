//! `lucerna watch` as a tool sees it: lines of JSON, and an end when it is told.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};

use serde_json::Value;

use super::{MTL, OBJ, SCENE, copy};
use crate::support::patience::Patience;

/// A process that is ended with the test.
struct Watch {
    child: Child,
    lines: Receiver<String>,
}

impl Watch {
    fn start(folder: &Path) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
            .args(["watch", "scene.ron", "--quiet", "--spp", "8", "-D", "render.max_depth=2"])
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let stdout: ChildStdout = child.stdout.take().unwrap();
        // A thread, so that a line that does not come fails the test.
        std::thread::spawn(move || {
            BufReader::new(stdout).lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
        Watch { child, lines }
    }

    /// The next line, as long as the process gets on.
    fn line(&self, kind: &str) -> String {
        let mut patience = Patience::with(self.child.id());
        loop {
            match self.lines.recv_timeout(patience.moment(kind)) {
                Ok(line) => return line,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => panic!("it ended without `{kind}`"),
            }
        }
    }

    /// Reads up to the next event of a kind.
    fn next(&mut self, kind: &str) -> Value {
        loop {
            let line = self.line(kind);
            let event: Value = serde_json::from_str(&line).unwrap_or_else(|error| panic!("{line}: {error}"));
            if event["event"] == kind {
                return event;
            }
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &folder.path().join("shaders"));
    for (name, text) in [("room.obj", OBJ), ("room.mtl", MTL), ("scene.ron", SCENE)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

#[test]
fn a_tool_reads_one_event_a_line() {
    let folder = folder();
    let mut watch = Watch::start(folder.path());
    assert_eq!(watch.next("watching")["size"], serde_json::json!([24, 16]));
    assert_eq!(watch.next("finished")["spp"], 8);

    let file = folder.path().join("shaders/lib/sampling.wgsl");
    let good = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, good.replace("return Angle(sqrt(1.0 - u)", "return Angle(0.5 * sqrt(1.0 - u)")).unwrap();
    let event = watch.next("reloaded");
    assert_eq!(event["files"], serde_json::json!(["shaders/lib/sampling.wgsl"]));
    assert_eq!(event["restarts"], serde_json::json!(["film"]));
    assert!(watch.next("first_pixels")["milliseconds"].as_f64().unwrap() > 0.0);
    watch.next("finished");

    std::fs::write(&file, good.replace("return Angle(sqrt(1.0 - u)", "return Angle(sqrt(1.0 - v)")).unwrap();
    let event = watch.next("failed");
    assert_eq!((&event["file"], &event["column"]), (&"shaders/lib/sampling.wgsl".into(), &29.into()));
    assert!(event["message"].as_str().unwrap().contains("`v`"), "{event}");
    assert_eq!(event["problems"].as_array().unwrap().len(), 1);

    // The command line still speaks over the scene file.
    let scene = folder.path().join("scene.ron");
    std::fs::write(&scene, SCENE.replace("spp: 4", "spp: 5").replace("exposure: 0.0", "exposure: 2.0")).unwrap();
    assert_eq!(watch.next("reloaded")["restarts"], serde_json::json!(["picture"]));
}

#[cfg(unix)]
#[test]
fn it_ends_when_it_is_told() {
    let folder = folder();
    let mut watch = Watch::start(folder.path());
    watch.next("finished");
    let told = Command::new("kill").args(["-INT", &watch.child.id().to_string()]).status().unwrap();
    assert!(told.success());
    assert_eq!(watch.child.wait().unwrap().code(), Some(0));
}

/// An array that Mesa takes apart for ever.
#[cfg(unix)]
fn never_compiles(folder: &Path) {
    let file = folder.join("shaders/lib/bsdf/lambert.wgsl");
    let text = std::fs::read_to_string(&file).unwrap();
    let slow = text.replace("    return INV_PI * cos_theta;\n", &super::slow::with_array(65_536));
    assert!(slow != text);
    std::fs::write(&file, slow).unwrap();
}

/// Sends a signal, which is to end the process soon; its code.
#[cfg(unix)]
#[track_caller]
fn end(watch: &mut Watch, signal: &str) -> Option<i32> {
    assert!(Command::new("kill").args([signal, &watch.child.id().to_string()]).status().unwrap().success());
    let took = crate::support::patience::time_to_end(&mut watch.child, SOON);
    assert!(took.is_some(), "it goes on {SOON:?} after {signal}");
    watch.child.wait().unwrap().code()
}

/// A second, and as much again beside other tests.
#[cfg(unix)]
const SOON: std::time::Duration = std::time::Duration::from_secs(2);

#[cfg(unix)]
#[test]
fn it_ends_while_a_driver_compiles_without_end() {
    if !crate::support::gpu().is_software() {
        return;
    }
    // From the start, and by a save.
    let first = folder();
    never_compiles(first.path());
    let mut watch = Watch::start(first.path());
    assert!(watch.next("compiling")["seconds"].as_u64().unwrap() >= 1);
    assert_eq!(end(&mut watch, "-INT"), Some(0));

    let later = folder();
    let mut watch = Watch::start(later.path());
    watch.next("finished");
    never_compiles(later.path());
    let event = watch.next("compiling");
    assert_eq!(event["files"], serde_json::json!(["shaders/lib/bsdf/lambert.wgsl"]));
    assert_eq!(event["warnings"][0]["file"], "shaders/lib/bsdf/lambert.wgsl", "{event}");
    assert_eq!(end(&mut watch, "-TERM"), Some(0));
}

#[test]
fn what_is_wrong_from_the_start_ends_it() {
    let folder = folder();
    let file = folder.path().join("shaders/lib/sampling.wgsl");
    let text = std::fs::read_to_string(&file).unwrap().replace("sqrt(1.0 - u)", "sqrt(1.0 - v)");
    std::fs::write(&file, text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["watch", "scene.ron"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("shaders/lib/sampling.wgsl:13:29"), "{message}");
}
