//! `lucerna new`: the scene that it writes is that of the model alone, and says what may be changed.

use std::path::Path;

use lucerna::scene::{Define, SceneDescription, load};

use super::{folder_with, lucerna, names, refused};

/// Materials of every kind, and names that are to be quoted.
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\nnewmtl \"pot\"\nKd 0.1 0.2 0.3\nKs 0.25 0.25 0.25\nNs 40\nillum 2\n\
                   newmtl clear.001\nKd 0 0 0\nNi 1.5\nillum 7\nTf 0.5 1 1\nnewmtl metal\nKd 0.9 0.8 0.1\nPr 0.25\nPm 1\nd 0.5\n";
const OBJ: &str = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 1\nusemtl grey\nf 1 2 3\nusemtl \"pot\"\nf 1 2 4\n\
                   usemtl clear.001\nf 2 3 4\nusemtl metal\nf 1 3 4\n";

fn loaded(path: &Path) -> SceneDescription {
    let loaded = load(path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    loaded.description
}

#[test]
fn the_scene_is_the_model_alone_and_its_commented_lines_are_its_materials() {
    let folder = folder_with("a.mtl", MTL.as_bytes());
    std::fs::create_dir(folder.path().join("models")).unwrap();
    for (name, text) in [("a.obj", OBJ), ("a.mtl", MTL)] {
        std::fs::write(folder.path().join("models").join(name), text).unwrap();
    }
    std::fs::create_dir(folder.path().join("scenes")).unwrap();
    let run = lucerna(folder.path(), &["new", "scenes/mine", "models/a.obj"]);
    let (out, said) = (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap());
    assert_eq!(run.status.code(), Some(0), "{said}");
    assert!(out.contains("scenes/mine.ron") && out.contains("next: lucerna view scenes/mine.ron"), "{out}");
    let path = folder.path().join("scenes/mine.ron");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"../models/a.obj\""), "{text}");
    let scene = loaded(&path);
    let alone = load(&folder.path().join("models/a.obj"), &[Define::given("film.size", "(800, 600)")]).unwrap();
    let alone = alone.description;
    assert_eq!(
        (scene.environment.clone(), scene.film, &scene.materials),
        (alone.environment, alone.film, &alone.materials)
    );
    let (camera, framed) = (scene.cameras[&scene.active], alone.cameras[&alone.active]);
    let distance = (framed.position - framed.look_at).length();
    assert!((camera.position - framed.position).length() < 2e-3 * distance, "{camera:?}, {framed:?}");
    // What is commented out changes nothing where it is taken in.
    let lines: Vec<String> = text
        .lines()
        .map(|line| match line.trim_start().strip_prefix("// \"") {
            Some(rest) if line.contains("kd: ") => format!("\"{rest}"),
            _ => line.to_owned(),
        })
        .collect();
    assert!(
        lines.iter().filter(|line| line.contains("kd: ") && !line.trim_start().starts_with("//")).count() == 4,
        "{text}"
    );
    std::fs::write(&path, lines.join("\n")).unwrap();
    assert_eq!(loaded(&path).materials, scene.materials);
    let lamp = text.replace("// lights:", "lights:");
    std::fs::write(&path, lamp).unwrap();
    assert_eq!(loaded(&path).lights.len(), 1);
}

#[test]
fn what_is_there_is_kept_but_by_force() {
    let folder = folder_with("", b"");
    let path = folder.path().join("b.ron");
    std::fs::write(&path, "mine").unwrap();
    let said = refused(2, folder.path(), &["new", "b", "a.obj"]);
    assert!(said.contains("b.ron: is there already") && said.contains("--force"), "{said}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    assert!(lucerna(folder.path(), &["new", "b.ron", "a.obj", "--force"]).status.success());
    assert_ne!(std::fs::read_to_string(&path).unwrap(), "mine");
    let said = refused(1, folder.path(), &["new", "c", "none.obj"]);
    assert!(said.contains("none.obj") && !folder.path().join("c.ron").exists(), "{said}");
}

#[test]
fn without_a_model_it_is_that_beside_or_the_teapot() {
    let folder = folder_with("pot.obj", OBJ.as_bytes());
    assert!(lucerna(folder.path(), &["new", "pot"]).status.success());
    assert!(std::fs::read_to_string(folder.path().join("pot.ron")).unwrap().contains("\"pot.obj\""));
    assert!(lucerna(folder.path(), &["new", "other"]).status.success());
    assert!(!loaded(&folder.path().join("other.ron")).meshes.is_empty());
    assert!(std::fs::read_to_string(folder.path().join("other.ron")).unwrap().contains("teapot.obj"));
}

#[test]
fn a_model_with_lamps_of_its_own_gets_no_sky() {
    let folder = folder_with("a.mtl", b"newmtl grey\nKe 5 5 5\n");
    assert!(lucerna(folder.path(), &["new", "lit", "a.obj"]).status.success());
    assert!(loaded(&folder.path().join("lit.ron")).environment.is_none());
}

#[test]
fn what_names_no_scene_or_no_model_is_refused_before_anything_is_written() {
    let folder = folder_with("x", b"");
    let before = names(folder.path());
    for (arguments, told) in [
        (&["a.obj"][..], "a.obj: is a model's name, and no scene's"),
        (&["./a.OBJ", "--force"], "lucerna new a ./a.OBJ"),
        (&["a", "a.ron", "--force"], "a.ron: is a scene file, and no model"),
        (&[".", "a.obj"], "is no name of a file"),
        (&["./", "a.obj"], "is no name of a file"),
        (&[".hidden", "a.obj"], "is no name of a file"),
    ] {
        let said = refused(2, folder.path(), &[&["new"], arguments].concat());
        assert!(said.contains(told), "{arguments:?}: {said}");
    }
    assert_eq!(names(folder.path()), before);
}
