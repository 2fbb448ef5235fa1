//! What frames share: each thing is done once, and each film is that of its scene alone.

use std::path::Path;

use lucerna::image::PictureFile;
use lucerna::scene::Define;

use super::{answer, folder, planned, scene, written};
use crate::support::families::{alone, bits, done};

fn film(folder: &Path, frame: &str) -> Vec<u32> {
    let file = folder.join("result/animate/a/members").join(format!("{frame}.exr"));
    bits(&PictureFile::open(&file).unwrap().read_all().unwrap())
}

#[test]
fn what_does_not_move_is_not_done_again_and_frames_are_as_alone() {
    let keys = r#"{ "cameras.front.position": Smooth({ 0: (0, 0, 3), 2: (1, 0.5, 3), 4: (0.5, 1, 4) }),
        "materials.grey.kd": { 2: (0.5, 0.5, 0.5), 4: (0.1, 0.9, 0.5) } }"#;
    let folder = folder(&[("a.ron", &scene(&format!("(frames: 7, keys: {keys})")))]);
    let answer = answer(folder.path(), &[], 0);
    let names = ["0000", "0001", "0002", "0003", "0004", "0005", "0006"];
    assert_eq!(done(&answer), names);
    let works = || answer.records.iter().map(|record| &record.work);
    assert_eq!(works().map(|work| work.trees).sum::<u64>(), 1, "the camera moves, and the material");
    assert_eq!(works().filter(|work| work.uploaded.contains_key("triangles")).count(), 1);
    assert_eq!(works().map(|work| work.compiled.get("path").copied().unwrap_or(0)).sum::<u64>(), 1);
    assert_eq!(works().map(|work| work.read).sum::<u32>(), 2, "a.obj and a.mtl; a.ron was read for its keys");
    // Those that stand still are one film.
    let shared: Vec<_> = answer.records.iter().map(|record| record.film_of.as_deref()).collect();
    assert_eq!(shared, [None, None, None, None, None, Some("0004"), Some("0004")]);

    let path = folder.path().join("a.ron");
    let family = planned(folder.path(), "a.ron").unwrap().unwrap();
    let mut films = Vec::new();
    for member in &family.members {
        // By what `-D` takes.
        let given: Vec<Define> =
            member.defines.iter().map(|define| Define::given(define.path.clone(), define.value.clone())).collect();
        let film = film(folder.path(), &member.name);
        assert_eq!(film, alone(&path, &given), "{}", member.name);
        films.push(film);
    }
    assert!(films[..5].windows(2).all(|two| two[0] != two[1]) && films[4] == films[6]);
    let repeat = &answer.records[1].repeat;
    assert!(repeat.starts_with("lucerna render a.ron ") && repeat.contains("-D 'cameras.front.position=("), "{repeat}");
}

/// A model that moves has a tree for each place, and the picture of each frame is another.
#[test]
fn a_model_that_moves_has_a_tree_a_place() {
    let keys = r#"{ "models.0.transform.rotate_y": { 0: 0, 3: 90 } }"#;
    let folder = folder(&[("a.ron", &scene(&format!("(frames: 3, keys: {keys})")))]);
    let answer = answer(folder.path(), &["--spp", "2"], 0);
    assert_eq!(answer.records.iter().map(|record| record.work.trees).collect::<Vec<_>>(), [1, 1, 1]);
    let path = folder.path().join("a.ron");
    let given =
        [("models.0.transform.rotate_y", "60"), ("render.spp", "2")].map(|(path, value)| Define::given(path, value));
    assert_eq!(film(folder.path(), "0002"), alone(&path, &given));
}

/// A frame that is wrong is marked, and the others are done; and there is no movie.
#[test]
fn a_frame_that_breaks_is_marked_and_the_others_are_done() {
    let keys = r#"{ "cameras.front.position": { 0: (0, 0, 2), 4: (0, 0, -2) } }"#;
    let folder = folder(&[("a.ron", &scene(&format!("(frames: 5, keys: {keys})")))]);
    let answer = answer(folder.path(), &["--spp", "1"], 1);
    assert_eq!(done(&answer), ["0000", "0001", "0003", "0004"]);
    assert_eq!(answer.remarks, ["no movie: 1 of 5 frames are not done"]);
}

#[test]
fn flags_change_what_keys_leave() {
    let folder = folder(&[("a.ron", &scene(r#"(frames: 12, keys: { "film.exposure": { "0s": 0, "0.5s": 6 } })"#))]);
    let answer =
        answer(folder.path(), &["--fps", "12", "--frames", "2..4", "--size", "8x6", "-D", "film.exposure=9"], 0);
    assert_eq!(done(&answer), ["0002", "0003"]);
    let exposures = |name: &str| {
        let record = answer.records.iter().find(|record| record.name == name).unwrap();
        record.settings.iter().rfind(|(path, _)| path == "film.exposure").unwrap().1.clone()
    };
    assert_eq!([exposures("0002"), exposures("0003")], ["2", "3"], "half a second is six frames");
    let picture = image::open(folder.path().join("result/animate/a/members/0002.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (8, 6));
}

/// Without a key of the seed all frames have one: noise stands still, as does what stands still.
#[test]
fn a_seed_may_have_keys() {
    assert_eq!(written(4, "render.seed", "{ 0: 0, 3: 3 }"), ["0", "1", "2", "3"]);
}
