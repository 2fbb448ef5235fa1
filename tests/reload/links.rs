//! Files and folders behind symbolic links are watched where they are; what is no file holds nothing up.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::{Bench, MTL, OBJ, SCENE};
use crate::files::{fifo, litter};

const SHADER: &str = "shaders/passes/display/display.wgsl";

/// Longer than a burst, and than the patience with half-saved files.
const SETTLED: Duration = Duration::from_millis(1200);

/// Moves a file to a folder of its own, and leaves a link in its place.
fn move_behind_link(root: &Path, name: &str, away: &str) {
    let (place, target) = (root.join(name), root.join(away));
    fs::create_dir_all(target.parent().unwrap()).unwrap();
    fs::rename(&place, &target).unwrap();
    symlink(&target, &place).unwrap();
}

fn picture(path: &Path, code: u8) {
    image::save_buffer(path, &[code; 8 * 4 * 3], 8, 4, image::ColorType::Rgb8).unwrap();
}

/// Writes another file and renames it over the real one, as vim, sed and most programs save.
fn save_by_rename(path: &Path, text: &str) {
    let beside = path.with_file_name("saved.tmp");
    fs::write(&beside, text).unwrap();
    fs::rename(beside, path).unwrap();
}

/// Has a link lead elsewhere, as `ln -sf` does it.
fn lead_to(link: &Path, target: &Path) {
    let _ = fs::remove_file(link);
    symlink(target, link).unwrap();
}

#[test]
fn each_kind_of_file_behind_a_link_is_seen_to_be_saved() {
    let mut bench = Bench::opened(|root| {
        picture(&root.join("sky.png"), 90);
        let scene = SCENE.replace("film:", "environment: Map(path: \"sky.png\"),\n    film:");
        fs::write(root.join("scene.ron"), scene).unwrap();
        move_behind_link(root, SHADER, "away/shaders/display.wgsl");
        move_behind_link(root, "room.obj", "away/models/room.obj");
        move_behind_link(root, "scene.ron", "away/scenes/real.ron");
        move_behind_link(root, "sky.png", "away/skies/sky.png");
        // A chain: to a link in a folder of its own, through a link of a folder.
        move_behind_link(root, "room.mtl", "away/materials/room.mtl");
        fs::create_dir(root.join("away/links")).unwrap();
        symlink("materials", root.join("away/behind")).unwrap();
        symlink("../behind/room.mtl", root.join("away/links/room.mtl")).unwrap();
        lead_to(&root.join("room.mtl"), Path::new("away/links/room.mtl"));
    });
    let root = bench.folder.path().to_path_buf();
    let away = |name: &str| root.join("away").join(name);
    let shader = bench.read(SHADER);
    let scene = bench.read("scene.ron");
    let kinds: [(&str, PathBuf, &str, [String; 3]); 4] = [
        (
            SHADER,
            away("shaders/display.wgsl"),
            "picture",
            [2, 3, 4].map(|n| shader.replace("srgb8(linear)", &format!("srgb8(linear * {n}.5)"))),
        ),
        (
            "room.mtl",
            away("materials/room.mtl"),
            "film",
            ["0.1", "0.2", "0.3"].map(|kd| MTL.replace("0.5 0.5 0.5", kd)),
        ),
        (
            "room.obj",
            away("models/room.obj"),
            "tree and film",
            ["1", "1.2", "1.4"].map(|y| OBJ.replace("v -1 2", &format!("v -1 {y}"))),
        ),
        (
            "scene.ron",
            away("scenes/real.ron"),
            "picture",
            ["1.0", "2.0", "3.0"].map(|e| scene.replace("exposure: 0.0", &format!("exposure: {e}"))),
        ),
    ];
    for (name, target, restarts, [first, second, third]) in &kinds {
        fs::write(root.join(name), first).unwrap();
        assert_eq!(bench.reloaded(), *restarts, "{name} through the link");
        fs::write(target, second).unwrap();
        assert_eq!(bench.reloaded(), *restarts, "{name} at its target");
        save_by_rename(target, third);
        assert_eq!(bench.reloaded(), *restarts, "{name} by a rename at its target");
        assert!(fs::symlink_metadata(root.join(name)).unwrap().is_symlink());
    }
    picture(&away("skies/sky.png"), 200);
    assert_eq!(bench.reloaded(), "film", "the environment at its target");
    // A link on the way leads elsewhere.
    fs::create_dir(away("others")).unwrap();
    fs::write(away("others/room.mtl"), MTL).unwrap();
    lead_to(&away("behind"), Path::new("others"));
    assert_eq!(bench.reloaded(), "film", "the folder's link");
    fs::write(away("others/room.mtl"), MTL.replace("3 3 3", "4 4 4")).unwrap();
    assert_eq!(bench.reloaded(), "film", "the new target");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn a_link_that_leads_elsewhere_is_another_file() {
    let mut bench = Bench::opened(|root| {
        move_behind_link(root, "room.mtl", "mtl/a.mtl");
        move_behind_link(root, SHADER, "kept/display.wgsl");
        // The whole folder of shaders is behind a link, as packages have it.
        fs::rename(root.join("shaders"), root.join("v1")).unwrap();
        super::copy(&root.join("v1"), &root.join("v2"));
        symlink("v1", root.join("shaders")).unwrap();
        // Equally long, equally old.
        fs::write(root.join("mtl/b.mtl"), MTL.replace("0.5 0.5 0.5", "0.6 0.5 0.5")).unwrap();
        let old = SystemTime::now() - Duration::from_secs(1000);
        for name in ["mtl/a.mtl", "mtl/b.mtl"] {
            fs::File::options().append(true).open(root.join(name)).unwrap().set_modified(old).unwrap();
        }
        let text = fs::read_to_string(root.join("v2/passes/display/display.wgsl")).unwrap();
        fs::write(root.join("v2/passes/display/display.wgsl"), text.replace("srgb8(", "srgb8(0.5 * ")).unwrap();
    });
    let root = bench.folder.path().to_path_buf();
    lead_to(&root.join("room.mtl"), Path::new("mtl/b.mtl"));
    assert_eq!(bench.reloaded(), "film", "another library");
    bench.replace("mtl/b.mtl", "0.6 0.5 0.5", "0.7 0.5 0.5");
    assert_eq!(bench.reloaded(), "film", "the library that it leads to now");
    bench.replace("mtl/a.mtl", "0.5 0.5 0.5", "0.1 0.5 0.5");
    assert_eq!(bench.count_for(SETTLED), (0, 0), "the one that it led to");

    lead_to(&root.join("shaders"), Path::new("v2"));
    assert_eq!(bench.reloaded(), "picture", "another folder of shaders");
    bench.replace("v2/passes/display/display.wgsl", "srgb8(0.5 * ", "srgb8(0.6 * ");
    assert_eq!(bench.reloaded(), "picture", "the folder that it leads to now");
    bench.replace("kept/display.wgsl", "srgb8(", "srgb8(0.8 * ");
    assert_eq!(bench.count_for(SETTLED), (0, 0), "a file that only the last folder led to");
    lead_to(&root.join("shaders"), Path::new("v1"));
    assert_eq!(bench.reloaded(), "picture", "back");

    // Nowhere: told with the link and its target, and mended by either.
    lead_to(&root.join("room.obj"), Path::new("later/room.obj"));
    let (file, line, _, message) = bench.failed();
    assert_eq!((file.as_str(), line), ("scene.ron", 2));
    assert!(message.contains("room.obj") && message.contains("later/room.obj"), "{message}");
    fs::create_dir(root.join("later")).unwrap();
    std::thread::sleep(Duration::from_millis(100));
    fs::write(root.join("later/room.obj"), OBJ.replace("v -1 2", "v -1 1")).unwrap();
    assert_eq!(bench.reloaded(), "tree and film", "the target has come");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn what_is_no_file_holds_no_save_up() {
    let mut bench = Bench::new();
    litter(&bench.path("shaders"), "wgsl");
    litter(&bench.path("shaders/lib"), "wgsl");
    assert_eq!(bench.count_for(SETTLED), (0, 0), "nothing of it is a module");
    bench.replace(SHADER, "srgb8(", "srgb8(0.9 * ");
    assert_eq!(bench.reloaded(), "picture");

    for make in
        [fifo as fn(&Path), |path| lead_to(path, Path::new("room.obj")), |path| lead_to(path, Path::new("/dev/zero"))]
    {
        // In its place at once: that it was gone for a moment is another failure.
        make(&bench.path("other"));
        fs::rename(bench.path("other"), bench.path("room.obj")).unwrap();
        let (file, .., message) = bench.failed();
        assert!(file == "scene.ron" && message.contains("room.obj"), "{file}: {message}");
        fs::remove_file(bench.path("room.obj")).unwrap();
        bench.write("room.obj", OBJ);
        assert_eq!(bench.reloaded(), "nothing");
    }
    assert!(bench.engine.problems().is_empty());
}
