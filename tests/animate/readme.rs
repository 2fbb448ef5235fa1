//! The example of docs/animations.md, and what is shipped.

use std::path::{Path, PathBuf};

use lucerna::scene::Assets;
use lucerna::scene::variants::{frames, load};

use super::{MTL, OBJ, answer};
use crate::support::families::done;

/// The block of docs/animations.md that has an animation.
fn example() -> String {
    let page = std::fs::read_to_string("docs/animations.md").unwrap();
    let blocks = page.split("```ron\n").skip(1).filter_map(|rest| rest.split("```").next());
    blocks.map(str::to_owned).find(|block| block.contains("animate: (")).expect("an example")
}

/// Reads all frames. How many there are.
fn load_all(scene: &Path) -> usize {
    let assets = Assets::new();
    let family = frames(scene, &[], &assets).unwrap_or_else(|found| panic!("{found:?}")).expect("an animation");
    for member in &family.members {
        let loaded = load(&family, member, &Default::default(), &assets).0;
        let loaded = loaded.unwrap_or_else(|found| panic!("{}: {found:?}", member.name));
        assert!(loaded.warnings.is_empty(), "{}: {:?}", member.name, loaded.warnings);
    }
    assert!(assets.reads().values().all(|count| *count == 1));
    family.members.len()
}

#[test]
fn the_example_is_one_of_the_teapot() {
    let folder = tempfile::tempdir().unwrap();
    let teapot = std::fs::canonicalize("assets/scenes/teapot.ron").unwrap();
    let text = example().replace("\"teapot.ron\"", &format!("{:?}", teapot.display().to_string()));
    std::fs::write(folder.path().join("a.ron"), text).unwrap();
    assert_eq!(load_all(&folder.path().join("a.ron")), 48);
}

/// The same of a smaller teapot.
#[test]
fn the_example_can_be_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let teapot = super::scene("None").replace("(21, 13)", "(8, 8)");
    let files = [
        ("a.ron", &*example()),
        ("teapot.ron", &*teapot),
        ("a.obj", &*OBJ.replace("grey", "teapot")),
        ("a.mtl", &*MTL.replace("grey", "teapot")),
    ];
    for (file, text) in files {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    assert_eq!(done(&answer(folder.path(), &["--spp", "1"], 0)).len(), 48);
}

#[test]
fn what_is_shipped_can_be_loaded() {
    let scenes = std::fs::read_dir("assets/scenes").unwrap().map(|entry| entry.unwrap().path());
    let animated: Vec<PathBuf> =
        scenes.filter(|path| std::fs::read_to_string(path).unwrap().contains("animate:")).collect();
    assert!(!animated.is_empty());
    for path in animated {
        assert!(load_all(&path) > 1, "{}", path.display());
    }
}
