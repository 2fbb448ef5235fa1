//! Files that a window is opened on, to be edited.

use std::path::Path;

use tempfile::TempDir;

/// A folder with a copy of the Cornell box, `scene.ron` with its model.
pub fn cornell_box() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["cornell-box.obj", "cornell-box.mtl"] {
        std::fs::copy(root.join("assets/models").join(name), folder.path().join(name)).unwrap();
    }
    let scene = std::fs::read_to_string(root.join("assets/scenes/cornell-box.ron")).unwrap();
    std::fs::write(folder.path().join("scene.ron"), scene.replace("../models/", "")).unwrap();
    folder
}
