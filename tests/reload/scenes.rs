//! Scene files, models and material libraries that are edited, and those that come to be named.

use std::fs;

use super::{Bench, MTL, OBJ};

#[test]
fn what_a_scene_names_anew_is_watched_too() {
    let mut bench = Bench::new();
    let more = "models: [(path: \"room.obj\"), (path: \"parts/more.obj\")";
    bench.replace("scene.ron", "models: [(path: \"room.obj\")", more);
    let (file, .., message) = bench.failed();
    assert_eq!(file, "scene.ron");
    assert!(message.contains("more.obj"), "{message}");

    // The folder is made first, as git and people do.
    fs::create_dir(bench.path("parts")).unwrap();
    std::thread::sleep(std::time::Duration::from_millis(100));
    bench.write("parts/room.mtl", MTL);
    bench.write("parts/more.obj", &OBJ.replace("v -1 2", "v -1 1"));
    assert_eq!(bench.reloaded(), "tree and film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);

    bench.replace("parts/more.obj", "v 1 2 -1", "v 1 1.5 -1");
    assert_eq!(bench.reloaded(), "tree and film");
    bench.replace("parts/room.mtl", "Kd 0.5 0.5 0.5", "Kd 0.5 0.2 0.5");
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn a_feature_that_is_used_for_the_first_time_is_compiled() {
    let mut bench = Bench::new();
    bench.replace("room.mtl", "Kd 0.5 0.5 0.5", "Kd 0.1 0.1 0.1\nKs 0.6 0.6 0.6\nNs 50");
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
    bench.replace("scene.ron", "integrator: Bsdf", "integrator: Path");
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}
