//! What was judged on one scene, and what may be said of another by it.

use std::path::Path;

use glam::DVec3;
use lucerna::app::window::alike::{is_alike, looks_alike};
use lucerna::scene::{SceneDescription, load};

type Change = fn(&mut SceneDescription);

#[test]
fn verdicts_hold_from_everywhere_and_pictures_from_one_place() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
    let seen = load(&path, &[]).expect("a scene").description;
    assert!(is_alike(&seen, &seen.clone()) && looks_alike(&seen, &seen.clone()));
    let moved: [Change; 3] = [
        |scene| scene.cameras.values_mut().for_each(|camera| camera.position += DVec3::X),
        |scene| scene.film.size.x += 1,
        |scene| scene.film.exposure += 1.0,
    ];
    let another: [Change; 3] = [
        |scene| scene.materials.values_mut().for_each(|material| material.kd *= 0.5),
        |scene| scene.render.max_depth += 1,
        |scene| drop(scene.meshes.pop_first()),
    ];
    for (change, alike) in moved.map(|change| (change, true)).into_iter().chain(another.map(|change| (change, false))) {
        let mut scene = seen.clone();
        change(&mut scene);
        assert_eq!(is_alike(&seen, &scene), alike);
        assert!(!looks_alike(&seen, &scene), "pictures of one are not those of the other");
    }
}
