//! Scene files: their fields, defines over them, what becomes of materials, checking, and entities.

mod apply;
mod check;
mod defines;
mod fields;
mod materials;

use lucerna::scene::{Define, Diagnostics, Loaded, SceneDescription, load};

/// A square of two triangles in a red material.
const SQUARE: &str = "mtllib square.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n";
const SQUARE_MTL: &str = "newmtl red\nKd 0.8 0.1 0.1\n";

const SCENE: &str = r#"(
    models: [(path: "square.obj", transform: (translate: (1, 2, 3), rotate_z: 90.0, scale: 2))],
    cameras: {
        "front": (position: (0, 0, 5), look_at: (0, 0, 0), fov_y: 30),
        "top": (position: (0, 5, 0), look_at: (0, 0, 0), up: (0, 0, -1)),
    },
    camera: "front",
    film: (size: (64, 32), crop: (0, 16, 4, 8), exposure: 1.5),
    render: (integrator: Bsdf, max_depth: 4, roulette: false, energy: AsWritten, seed: 7, spp: 8),
    environment: Constant((0.5, 0.25, 1)),
    materials: { "red": (ns: 32, ks: 0.5) },
)"#;

/// A folder with a scene and its model.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    folder
}

fn load_text(scene: &str, defines: &[(&str, &str)]) -> Result<Loaded, Diagnostics> {
    let folder = folder(&[("square.obj", SQUARE), ("square.mtl", SQUARE_MTL), ("scene.ron", scene)]);
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(&folder.path().join("scene.ron"), &defines)
}

fn description(scene: &str) -> SceneDescription {
    load_text(scene, &[]).unwrap_or_else(|errors| panic!("{errors}")).description
}
