//! A Wayland display that the environment names, and that is not there.

use std::fs;
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use super::xvfb::{Xvfb, await_some};

/// A process that is ended with the test.
struct View(Child);

impl Drop for View {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Opens a window with these environment variables, and `folder` as the one that holds sockets.
fn view(folder: &Path, environment: &[(&str, &str)]) -> View {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(["view", "cornell-box", "--size", "64x48"]).current_dir(folder).env("XDG_RUNTIME_DIR", folder);
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command.envs(environment.iter().copied());
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(fs::File::create(folder.join("stderr")).unwrap());
    View(command.spawn().unwrap())
}

#[test]
fn a_wayland_display_that_does_not_answer_gives_way_to_x() {
    let display = Xvfb::start();
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    // A compositor that is gone leaves its socket; another program is no compositor; one that hangs takes connections, and says nothing.
    drop(UnixListener::bind(path("left")).unwrap());
    fs::write(path("plain"), "").unwrap();
    let _silent = UnixListener::bind(path("silent")).unwrap();
    let absolute = path("left").display().to_string();
    let cases: [(&str, &str, &str); 8] = [
        ("WAYLAND_DISPLAY", "wayland-77", "wayland-77"),
        ("WAYLAND_DISPLAY", "left", "left"),
        ("WAYLAND_DISPLAY", &absolute, "left"),
        ("WAYLAND_DISPLAY", "plain", "plain"),
        ("WAYLAND_DISPLAY", "silent", "silent"),
        ("WAYLAND_SOCKET", "9999", "WAYLAND_SOCKET"),
        ("WAYLAND_SOCKET", "none", "WAYLAND_SOCKET"),
        // Set, but to nothing: as if it were not.
        ("WAYLAND_DISPLAY", "", ""),
    ];
    for (name, value, word) in cases {
        let window = view(folder.path(), &[("DISPLAY", &display.name), (name, value)]);
        await_some(window.0.id(), &format!("a window on X with {name}={value}"), || display.window("Lucerna"));
        let said = fs::read_to_string(path("stderr")).unwrap();
        assert!(said.contains(word), "{name}={value}: {said}");
        assert_eq!(said.contains("opens on X instead"), !word.is_empty(), "{name}={value}: {said}");
        drop(window);
        await_some(std::process::id(), "the window to go", || display.window("Lucerna").is_none().then_some(()));
    }
}

#[test]
fn a_wayland_display_that_does_not_answer_and_no_x_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for environment in
        [&[("WAYLAND_DISPLAY", "wayland-77")][..], &[("WAYLAND_DISPLAY", "wayland-77"), ("DISPLAY", ":7777")]]
    {
        let mut view = view(folder.path(), environment);
        let status = await_some(view.0.id(), "the end", || view.0.try_wait().unwrap());
        let said = fs::read_to_string(folder.path().join("stderr")).unwrap();
        assert_eq!(status.code(), Some(1), "{said}");
        assert!(
            said.contains("no display") && said.contains("wayland-77") && said.contains("lucerna render"),
            "{said}"
        );
        assert_eq!(said.matches("error:").count(), 1, "{said}");
        assert!(!said.contains(".rs:") && !said.contains("panicked"), "{said}");
    }
}
