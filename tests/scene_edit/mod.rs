//! Edits of scene files' texts: every kind of change, in every layout, read back as what it was.

mod changes;
mod fuzz;
mod layouts;
mod places;
mod saving;
mod shipped;

use std::path::Path;

use lucerna::scene::edit::{Edited, edit};
use lucerna::scene::{Assets, Loading, SceneDescription, SceneText, attempt_in};

/// A square of two triangles in two materials.
const SQUARE: &str = "mtllib square.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl my.mat \"x\"\nf 1 3 4\n";
const SQUARE_MTL: &str = "newmtl red\nKd 0.8 0.1 0.1\nPr 0.3\nnewmtl my.mat \"x\"\nKd 0.5 0.5 0.5\n";

/// A folder with the square, and scene files.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in [("square.obj", SQUARE), ("square.mtl", SQUARE_MTL)].iter().chain(files) {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    folder
}

/// A scene and its text, by files as they were read first.
fn read(path: &Path, assets: &Assets) -> (SceneDescription, SceneText) {
    assets.refresh();
    let (loaded, _) = attempt_in(path, &[], true, &Loading::default(), assets);
    let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}\n{}", std::fs::read_to_string(path).unwrap()));
    (loaded.description, loaded.text)
}

/// Edits a scene file by `change`, writes it, and reads it again. Returns the text before, and what became of it.
#[track_caller]
fn edited(path: &Path, change: impl FnOnce(&mut SceneDescription)) -> (String, Edited) {
    let assets = Assets::new();
    let (before, text) = read(path, &assets);
    let mut after = before.clone();
    change(&mut after);
    let edited = edit(&text, &before, &after).unwrap_or_else(|error| panic!("{error}"));
    assert!(edited.left_out.is_empty(), "{:?}", edited.left_out);
    std::fs::write(path, &edited.text).expect("a file");
    let (again, again_text) = read(path, &assets);
    assert_same(&again, &after, &edited.text);
    // Once it is written, there is nothing to write.
    let twice = edit(&again_text, &before, &after).unwrap_or_else(|error| panic!("{error}"));
    assert!(twice.is_unchanged() && twice.text == edited.text, "{}\n{}", edited.text, twice.text);
    (text.text().expect("a text").to_owned(), edited)
}

/// Two scenes are one, but for meshes and pictures.
#[track_caller]
fn assert_same(read: &SceneDescription, wanted: &SceneDescription, text: &str) {
    assert_eq!(read.cameras, wanted.cameras, "{text}");
    assert_eq!(read.active, wanted.active, "{text}");
    assert_eq!(read.lights, wanted.lights, "{text}");
    assert_eq!(read.film, wanted.film, "{text}");
    assert_eq!(read.render, wanted.render, "{text}");
    assert_eq!(read.shader, wanted.shader, "{text}");
    assert!(read.environment == wanted.environment, "{text}");
    for (name, material) in &wanted.materials {
        assert_eq!(&read.materials[name], material, "{name}\n{text}");
    }
}
