//! All shipped scenes, changed at random again and again: what is written is read as it was, and the rest is there to the byte.

use std::path::{Path, PathBuf};

use lucerna::scene::edit::edit;
use lucerna::scene::{Assets, apply, describe};

use super::changes::{KINDS, change};
use super::{assert_same, read};
use crate::support::dice::Dice;

/// Edits of each scene, each of a few changes; the text goes from one to the next.
const EDITS: u64 = 12;

/// A folder with copies of the scenes, beside the models.
#[cfg(unix)]
fn copies(change: impl Fn(String) -> String) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    std::os::unix::fs::symlink(assets.join("models"), folder.path().join("models")).expect("a link");
    std::fs::create_dir(folder.path().join("scenes")).expect("a folder");
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir(assets.join("scenes")).expect("the scenes").flatten() {
        let text = std::fs::read_to_string(entry.path()).expect("a scene");
        let copy = folder.path().join("scenes").join(entry.file_name());
        std::fs::write(&copy, change(text)).expect("a file");
        scenes.push(copy);
    }
    scenes.sort();
    (folder, scenes)
}

/// The comments of a text, in order: shipped scenes have no `//` in strings.
fn comments(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.find("//").map(|at| line[at..].trim_end())).collect()
}

#[cfg(unix)]
fn change_all(seed: u64, convert: fn(String) -> String, check: fn(&str)) {
    let (_folder, scenes) = copies(convert);
    assert!(scenes.len() > 10);
    let assets = Assets::new();
    let mut dice = Dice(seed);
    for scene in &scenes {
        let (mut before, mut text) = read(scene, &assets);
        let first = text.text().expect("a text").to_owned();
        for round in 0..EDITS {
            let mut after = before.clone();
            for _ in 0..=(round % 4) {
                let kind = (dice.unit() * KINDS as f64) as usize;
                change(&mut after, kind, &mut dice);
            }
            let edited = edit(&text, &before, &after).unwrap_or_else(|error| panic!("{error}"));
            assert!(edited.left_out.is_empty(), "{:?}\n{}", edited.left_out, edited.text);
            std::fs::write(scene, &edited.text).expect("a file");
            let (again, again_text) = read(scene, &assets);
            assert_same(&again, &after, &format!("{}: {}", scene.display(), edited.text));
            let twice = edit(&again_text, &before, &after).expect("an edit");
            assert!(twice.is_unchanged(), "{:?}\n{}\n{}", twice.paths, edited.text, twice.text);
            check(&edited.text);
            (before, text) = (again, again_text);
        }
        let last = text.text().expect("a text");
        assert_eq!(comments(&first), comments(last), "{last}");
        // Those that extend this one are read with what it was.
        std::fs::write(scene, first).expect("a file");
    }
}

#[cfg(unix)]
#[test]
fn changes_of_shipped_scenes_are_read_back_as_they_were() {
    change_all(1, |text| text, |text| assert!(!text.contains('\r')));
}

#[cfg(unix)]
#[test]
fn files_keep_the_ends_of_their_lines() {
    let lone = |text: &str| assert_eq!(text.matches('\n').count(), text.matches("\r\n").count(), "{text}");
    change_all(2, |text| text.replace('\n', "\r\n"), lone);
}

/// One value at a time: what stands before it and behind it is the same, to the byte.
#[cfg(unix)]
#[test]
fn a_changed_value_touches_nothing_else() {
    let (_folder, scenes) = copies(|text| text);
    let assets = Assets::new();
    for scene in scenes
        .iter()
        .filter(|scene| scene.ends_with("scenes/glass.ron") || scene.ends_with("scenes/teapot-daylight.ron"))
    {
        for seed in 0..60 {
            let (before, text) = read(scene, &assets);
            let mut after = before.clone();
            let mut dice = Dice(seed);
            change(&mut after, (seed % KINDS as u64) as usize, &mut dice);
            let edited = edit(&text, &before, &after).expect("an edit");
            let (old, new) = (text.text().expect("a text"), edited.text.as_str());
            let head = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
            let rest = (old.len() - head).min(new.len() - head);
            let tail = old.bytes().rev().zip(new.bytes().rev()).take(rest).take_while(|(a, b)| a == b).count();
            let gone = &old[head..old.len() - tail];
            assert!(gone.len() < 60 && !gone.contains(['\n', ':']), "`{gone}` is gone\n{old}\n{new}");
        }
    }
}

/// What the engine makes of a scene is described as the scene was: nothing of it is an edit.
#[cfg(unix)]
#[test]
fn what_nobody_touched_is_not_written() {
    let (_folder, scenes) = copies(|text| text);
    let assets = Assets::new();
    for scene in &scenes {
        let (before, text) = read(scene, &assets);
        let mut world = bevy_ecs::world::World::new();
        apply(&mut world, &before);
        let edited = edit(&text, &before, &describe(&world, &before.name)).expect("an edit");
        assert!(edited.is_unchanged() && edited.left_out.is_empty(), "{}: {:?}", scene.display(), edited.paths);
    }
}
