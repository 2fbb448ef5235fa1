//! Families of scenes: their files, how members share what they have in common, and what is told of them.

mod files;
mod wrong;

use std::path::{Path, PathBuf};

use lucerna::scene::variants::{Family, plan};
use lucerna::scene::{Assets, Diagnostic, Diagnostics};
use tempfile::TempDir;

/// A folder with files.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

/// A scene that is a lit triangle.
const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40), "side": (position: (3, 0, 0), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (8, 6)),
    render: (spp: 2, max_depth: 3),
    environment: Constant(1.0),
)"#;

const MODEL: &str = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

const LIBRARY: &str = "newmtl a\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nNs 20\n";

/// A folder with that scene, and a variant file `v.ron`.
fn with_family(text: &str) -> TempDir {
    folder(&[("a.ron", SCENE), ("a.obj", MODEL), ("a.mtl", LIBRARY), ("v.ron", text)])
}

fn planned(folder: &Path) -> Result<Family, Diagnostics> {
    plan(&folder.join("v.ron"), &[], &Assets::new())
}

/// The errors of all members as they are loaded.
fn load_all(family: &Family) -> Vec<(String, Option<Vec<Diagnostic>>)> {
    let assets = Assets::new();
    let load = |member: &lucerna::scene::variants::Member| {
        let loaded = lucerna::scene::attempt_in(&family.scene, &member.defines, &Default::default(), &assets).0;
        (member.name.clone(), loaded.err().map(|found| found.list))
    };
    family.members.iter().map(load).collect()
}

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/variants");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == "ron")).collect();
    files.sort();
    files
}
