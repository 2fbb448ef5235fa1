//! What keeps a texture from being seen as its picture is, and is no error: told at its line, once.

use lucerna::scene;

use super::encoded;

/// Texture coordinates of the faces, and what they are named by.
const PLACED: (&str, &str) = ("vt 0 0\nvt 1 0\nvt 0 1\n", "f 1/1 2/2 3/3\n");
const UNPLACED: (&str, &str) = ("", "f 1 2 3\n");

/// What is told of a triangle whose material has these statements and a picture `a.png`.
fn told(statements: &str, (uvs, face): (&str, &str)) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let obj = format!("mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\n{uvs}usemtl a\n{face}o other\nusemtl a\n{face}");
    write("a.obj", obj.as_bytes());
    write("a.mtl", format!("newmtl a\n{statements}\nnewmtl b\n{statements}\n").as_bytes());
    write("a.png", &encoded(image::ImageFormat::Png, [1, 1], image::ExtendedColorType::Rgb8, &[90, 120, 150]));
    let loaded = scene::load(&folder.path().join("a.obj"), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let text = |warning: &scene::Diagnostic| {
        let name = warning.file.file_name().unwrap().to_string_lossy();
        format!("{name}:{}:{}: {}", warning.line, warning.column, warning.message)
    };
    loaded.warnings.iter().map(text).collect()
}

#[test]
fn a_highlight_that_is_a_veil_is_told() {
    // What Blender 2.7 writes on everything.
    let all = told("Ns 96.078431\nKd 0.64 0.64 0.64\nKs 0.5 0.5 0.5\nillum 2\nmap_Kd a.png", PLACED);
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(all[0].starts_with("a.mtl:4:1: material `a` has a `Ks` of 0.5 beside `map_Kd`"), "{all:?}");
    assert!(!all[0].contains("noisy"), "{all:?}");
    let wide = told("Ns 0\nKd 0.8 0.8 0.8\nKs 0.8 0.8 0.8\nmap_Kd a.png", PLACED);
    assert!(wide.len() == 1 && wide[0].contains("so widely by `Ns 0` that it is noisy"), "{wide:?}");
    assert_eq!(told("Kd 1 1 1\nKs 0.5 0.5 0.5\nPr 0.5\nmap_Kd a.png", PLACED).len(), 1);
    for plain in [
        "Kd 1 1 1\nKs 0.2 0.2 0.2\nmap_Kd a.png",
        "Kd 1 1 1\nKs 0.9 0.5 0.1\nmap_Kd a.png",
        "Kd 1 1 1\nKs 0.5 0.5 0.5",
        "Kd 1 1 1\nKs 0.5 0.5 0.5\nmap_Kd a.png\nmap_Ks a.png",
        "Kd 1 1 1\nKs 0.5 0.5 0.5\nillum 3\nmap_Kd a.png",
    ] {
        assert_eq!(told(plain, PLACED), Vec::<String>::new(), "{plain}");
    }
}

#[test]
fn maps_of_faces_without_texture_coordinates_are_told() {
    let all = told("Kd 1 1 1\nmap_Kd a.png", UNPLACED);
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(
        all[0].starts_with("a.obj:5:8: material `a` has maps, but faces here have no texture coordinates"),
        "{all:?}"
    );
    assert_eq!(told("Kd 1 1 1", UNPLACED), Vec::<String>::new());
}
