//! The movie of the frames: by ffmpeg where that is found, and a line that says why not.

use super::{answer, folder, run, scene};

const KEYS: &str = r#"(frames: 3, fps: 12, keys: { "film.exposure": { 0: 0, 2: 2 } })"#;

#[test]
fn without_ffmpeg_the_command_that_makes_the_movie_is_told() {
    let folder = folder(&[("a.ron", &scene(KEYS))]);
    let told = run(folder.path(), &["--spp", "1", "-o", "my movies"]);
    let said = String::from_utf8(told.stdout).unwrap();
    assert!(told.status.success(), "{said}");
    let line = said.lines().find(|line| line.contains("ffmpeg")).unwrap_or_else(|| panic!("{said}"));
    assert!(
        line.contains("no movie: ffmpeg is not installed; this would make it: cd 'my movies/a' && ffmpeg -y"),
        "{line}"
    );
    assert!(
        line.contains("-framerate 12 -start_number 0 -i members/%04d.png -frames:v 3") && line.ends_with("./a.mp4"),
        "{line}"
    );
    assert!(folder.path().join("my movies/a/members/0002.png").is_file());
}

/// An ffmpeg that is a script, beside the scene, where commands here look for it.
#[cfg(unix)]
fn pretend(folder: &std::path::Path, script: &str) {
    use std::os::unix::fs::PermissionsExt;
    let path = folder.join("ffmpeg");
    std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn an_ffmpeg_that_fails_leaves_the_frames() {
    let folder = folder(&[("a.ron", &scene(KEYS))]);
    pretend(folder.path(), "for last; do :; done; echo half > \"$last\"; echo 'Unknown encoder: libx264' >&2; exit 1");
    let failed = answer(folder.path(), &["--spp", "1"], 0);
    let [remark] = &failed.remarks[..] else { panic!("{:?}", failed.remarks) };
    assert!(remark.starts_with("no movie: Unknown encoder: libx264; this would make it: cd "), "{remark}");
    let left: Vec<_> = std::fs::read_dir(folder.path().join("result/animate/a")).unwrap().flatten().collect();
    let is_movie = |name: String| name.contains("mp4");
    assert!(!left.iter().any(|entry| is_movie(entry.file_name().to_string_lossy().into_owned())), "{left:?}");
    assert!(folder.path().join("result/animate/a/members/0002.png").is_file());
}

#[cfg(unix)]
#[test]
fn a_movie_is_of_the_frames_that_are_wanted() {
    let folder = folder(&[("a.ron", &scene(KEYS))]);
    pretend(folder.path(), "for last; do :; done; echo \"$@\" > \"$last\"");
    let movie = folder.path().join("result/animate/a/a.mp4");
    let part = answer(folder.path(), &["--spp", "1", "--frames", "1..2"], 0);
    assert_eq!(part.remarks, ["a.mp4: 0.08 s at 12 frames a second"]);
    let words = std::fs::read_to_string(&movie).unwrap();
    assert!(words.contains("-framerate 12 -start_number 1 ") && words.contains("-frames:v 1 "), "{words}");
    assert!(words.contains("-pix_fmt yuv420p") && words.contains("pad=ceil(iw/2)*2:ceil(ih/2)*2"), "{words}");
    let whole = answer(folder.path(), &["--spp", "1"], 0);
    assert_eq!(whole.remarks, ["a.mp4: 0.25 s at 12 frames a second"]);
    assert!(std::fs::read_to_string(&movie).unwrap().contains("-start_number 0 "));
}

/// A movie has one size.
#[cfg(unix)]
#[test]
fn frames_of_two_sizes_make_no_movie() {
    let sizes = r#"(frames: 2, keys: { "film.size": Step({ 0: (8, 6), 1: (6, 8) }) })"#;
    let folder = folder(&[("a.ron", &scene(sizes).replace("film: (size: (21, 13)), ", ""))]);
    pretend(folder.path(), "for last; do :; done; echo \"$@\" > \"$last\"");
    let told = answer(folder.path(), &["--spp", "1"], 0);
    assert_eq!(told.remarks, ["no movie: the frames 0000 and 0001 are of two sizes"]);
}

/// The frames are there, and so is the answer; the program that was started is not.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_what_makes_the_movie() {
    use crate::support::patience::{Patience, time_to_end};
    use std::process::{Command, Stdio};

    let folder = folder(&[("a.ron", &scene(KEYS))]);
    pretend(folder.path(), "echo $$ > started; exec /bin/sleep 1000");
    let mut command = super::command(folder.path(), &["--spp", "1", "--quiet"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let started = folder.path().join("result/animate/a/started");
    let mut patience = Patience::with(child.id());
    let other = loop {
        match std::fs::read_to_string(&started) {
            Ok(id) if id.ends_with('\n') => break id.trim().to_owned(),
            _ => patience.wait("ffmpeg"),
        }
    };
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert!(time_to_end(&mut child, std::time::Duration::from_secs(10)).is_some());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(folder.path().join("result/animate/a/answer.json").is_file());
    let lives = Command::new("kill").args(["-0", &other]).stderr(Stdio::null()).status().unwrap().success();
    assert!(!lives, "it goes on");
}
