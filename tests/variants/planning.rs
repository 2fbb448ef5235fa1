//! Small scenes with variant files, and what is planned of them.

use std::path::{Path, PathBuf};

use lucerna::scene::variants::{Family, plan};
use lucerna::scene::{Assets, Diagnostic, Diagnostics};
use tempfile::TempDir;

/// A folder with files.
pub fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

/// A scene that is a lit triangle.
pub const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40), "side": (position: (3, 0, 0), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (8, 6)),
    render: (spp: 2, max_depth: 3),
    environment: Constant(1.0),
)"#;

pub const MODEL: &str = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

pub const LIBRARY: &str = "newmtl a\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nNs 20\n";

/// A folder with that scene, and a variant file `v.ron`.
pub fn with_family(text: &str) -> TempDir {
    folder(&[("a.ron", SCENE), ("a.obj", MODEL), ("a.mtl", LIBRARY), ("v.ron", text)])
}

pub fn planned(folder: &Path) -> Result<Family, Diagnostics> {
    plan(&folder.join("v.ron"), &[], &Assets::new())
}

/// The errors of all members as they are loaded.
pub fn load_all(family: &Family) -> Vec<(String, Option<Vec<Diagnostic>>)> {
    let assets = Assets::new();
    let load = |member: &lucerna::scene::variants::Member| {
        let loaded = lucerna::scene::variants::load(family, member, &Default::default(), &assets).0;
        (member.name.clone(), loaded.err().map(|found| found.list))
    };
    family.members.iter().map(load).collect()
}

pub fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/variants");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == "ron")).collect();
    files.sort();
    files
}
