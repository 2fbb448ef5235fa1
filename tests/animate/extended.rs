//! Animations of scenes that extend others.

use super::{folder, planned, scene};

/// Maps are joined by name: paths, and the keys of a path; `None` takes one away.
#[test]
fn keys_are_joined_with_those_of_the_extended_scene() {
    let base = scene(
        r#"(frames: 9, fps: 12, keys: { "film.exposure": { 0: 0, 4: 4 }, "cameras.front.fov_y": { 0: 40 }, "render.seed": { 0: 3 } })"#,
    );
    let over = r#"(extends: "a.ron", animate: (frames: 5, keys: {
        "film.exposure": { 2: 4, 0: None }, "cameras.front.fov_y": Smooth({ 0: 20 }), "render.seed": None }))"#;
    let folder = folder(&[("a.ron", &base), ("b.ron", over), ("c.ron", r#"(extends: "a.ron", animate: None)"#)]);
    let family = planned(folder.path(), "b.ron").unwrap().unwrap();
    assert_eq!((family.members.len(), family.fps, family.name.as_str()), (5, Some(12.0), "b"));
    let defines = |frame: usize| -> Vec<(&str, &str)> {
        family.members[frame].defines.iter().map(|define| (define.path.as_str(), define.value.as_str())).collect()
    };
    assert_eq!(defines(0), [("film.exposure", "4"), ("cameras.front.fov_y", "20")]);
    assert_eq!(family.files.len(), 2);
    assert!(planned(folder.path(), "c.ron").unwrap().is_none());
}

/// Also those of a curve of the same name; what is of another curve takes the place of all.
#[test]
fn keys_of_a_curve_are_joined() {
    let base = scene(
        r#"(frames: 5, keys: { "film.exposure": Smooth({ 0: 0, 4: 4 }), "camera": Step({ 0: front, 2: near }), "render.seed": Step({ 0: 3 }) })"#,
    );
    let over = r#"(extends: "a.ron", animate: (keys: {
        "film.exposure": Smooth({ 0: 4 }), "camera": Step({ 2: front }), "render.seed": { 0: 1, 4: 5 } }))"#;
    let folder = folder(&[("a.ron", &base), ("b.ron", over)]);
    let family = planned(folder.path(), "b.ron").unwrap().unwrap();
    let defines: Vec<&str> = family.members[3].defines.iter().map(|define| define.value.as_str()).collect();
    assert_eq!(defines, ["4", "front", "4"]);
}
