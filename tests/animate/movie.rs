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
    let is_film = |name: String| name.contains("mp4");
    assert!(!left.iter().any(|entry| is_film(entry.file_name().to_string_lossy().into_owned())), "{left:?}");
    assert!(folder.path().join("result/animate/a/members/0002.png").is_file());
}

#[cfg(unix)]
#[test]
fn a_film_is_of_the_frames_that_are_wanted() {
    let folder = folder(&[("a.ron", &scene(KEYS))]);
    pretend(folder.path(), "for last; do :; done; echo \"$@\" > \"$last\"");
    let film = folder.path().join("result/animate/a/a.mp4");
    let part = answer(folder.path(), &["--spp", "1", "--frames", "1..2"], 0);
    assert_eq!(part.remarks, ["a.mp4: 0.08 s at 12 frames a second"]);
    let words = std::fs::read_to_string(&film).unwrap();
    assert!(words.contains("-framerate 12 -start_number 1 ") && words.contains("-frames:v 1 "), "{words}");
    assert!(words.contains("-pix_fmt yuv420p") && words.contains("pad=ceil(iw/2)*2:ceil(ih/2)*2"), "{words}");
    let whole = answer(folder.path(), &["--spp", "1"], 0);
    assert_eq!(whole.remarks, ["a.mp4: 0.25 s at 12 frames a second"]);
    assert!(std::fs::read_to_string(&film).unwrap().contains("-start_number 0 "));
}
