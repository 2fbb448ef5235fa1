//! Models of which nothing will be seen: said, and said only then.

use lucerna::scene::{Loaded, check, load};

const SQUARE: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\nusemtl b\nf 4 3 2 1\n";
const UNSEEN: &str = "nothing of this model will be seen";

struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    fn new(obj: &str, mtl: &str, scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [("m.obj", obj), ("m.mtl", mtl), ("s.ron", scene)] {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        Self { folder }
    }

    fn load(&self, name: &str) -> Loaded {
        load(&self.folder.path().join(name), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    }

    /// What loading the model, or the scene, says of what is not seen.
    fn unseen(&self, name: &str) -> Vec<String> {
        let all = self.load(name).warnings.into_iter().map(|warning| warning.to_string());
        all.filter(|text| text.contains("will be seen")).collect()
    }

    /// What checking the scene says of it.
    fn checked(&self) -> Vec<String> {
        let all = check(&self.folder.path().join("s.ron")).diagnostics.into_iter().map(|found| found.to_string());
        all.filter(|text| text.contains("will be seen")).collect()
    }
}

#[test]
fn a_model_of_invisible_materials_is_told() {
    for (mtl, unseen) in [
        ("newmtl a\nKd 1 0 0\nd 0\nnewmtl b\nKd 0 0 1\nd 0.0\n", true),
        ("newmtl a\nKd 1 0 0\nd 0\nTf 1 1 1\nillum 4\nnewmtl b\nd 0\nKd 1 1 1\n", true),
        ("newmtl a\nKd 1 0 0\nd 0\nnewmtl b\nKd 0 0 1\n", false),
        ("newmtl a\nKd 1 0 0\nd 0\nTf 0.5 1 1\nnewmtl b\nd 0\nKd 1 1 1\n", false),
        ("newmtl a\nKd 1 0 0\nd 0\nKe 1 1 1\nnewmtl b\nd 0\nKd 1 1 1\n", false),
        ("newmtl a\nKd 1 0 0\nd 0.01\nnewmtl b\nd 0\nKd 1 1 1\n", false),
        ("newmtl a\nd 0\nNi 1.5\nillum 7\nnewmtl b\nd 0\nKd 1 1 1\n", false),
    ] {
        let files = Files::new(SQUARE, mtl, "(models: [(path: \"m.obj\")])");
        for name in ["m.obj", "s.ron"] {
            let said = files.unseen(name);
            assert_eq!(said.len(), usize::from(unseen), "{mtl}: {said:?}");
            assert!(said.iter().all(|text| text.contains(UNSEEN) && text.contains("invisible")), "{said:?}");
        }
    }
    // A scene may hide one of its models, and show another.
    let mtl = "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n";
    let scene = "(models: [(path: \"m.obj\"), (path: \"m.obj\", name: \"n\")],\n materials: { \"n:a\": (d: 0), \"n:b\": (d: 0) })";
    let said = Files::new(SQUARE, mtl, scene).unseen("s.ron");
    assert!(said.len() == 1 && said[0].contains("s.ron:1:35: warning"), "{said:?}");
}

#[test]
fn a_model_without_area_is_told_at_any_scale() {
    let shapes = [
        ("v 1 2 3\nv 1 2 3\nv 1 2 3\n", true),
        ("v 0 0 0\nv 1 1 1\nv 2 2 2\n", true),
        ("v 0 0 0\nv 1 2 3\nv 0 0 0\n", true),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", false),
        ("v 1e11 0 0\nv 100000000001 0 0\nv 1e11 1 0\n", false),
        ("v 1e11 1e11 0\nv 100000000000.001 1e11 0\nv 1e11 100000000000.001 0\n", false),
        ("v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\n", false),
        ("v 0 0 0\nv 1e-200 0 0\nv 0 1e-200 0\n", false),
        ("v 0 0 0\nv 1e9 0 0\nv 0 1e9 0\n", false),
        ("v 0 0 0\nv 1e9 0 0\nv 0 1 0\n", false),
    ];
    for (vertices, flat) in shapes {
        let files = Files::new(&format!("{vertices}f 1 2 3\n"), "", "(models: [(path: \"m.obj\")])");
        for name in ["m.obj", "s.ron"] {
            let said = files.unseen(name);
            assert_eq!(said.len(), usize::from(flat), "{vertices}: {said:?}");
            assert!(said.iter().all(|text| text.contains(UNSEEN) && text.contains("no area")), "{said:?}");
        }
    }
}

/// A camera, and whether it has the square of 0 to 1 in the plane z = 0 behind it, or out of its view.
const CAMERAS: &[(&str, bool, bool)] = &[
    ("position: (0.5, 0.5, 5), look_at: (0.5, 0.5, 0)", false, false),
    ("position: (0.5, 0.5, 5), look_at: (0.5, 0.5, 9)", true, true),
    ("position: (0.5, 0.5, -1), look_at: (0.5, 0.5, -2)", true, true),
    ("position: (0.5, 0.5, 5), look_at: (50, 0.5, 0)", false, true),
    ("position: (0.5, 0.5, 5), look_at: (0.5, 9, 0)", false, true),
    // Within it: some is before it.
    ("position: (0.5, 0.5, 0), look_at: (1, 0.5, 0)", false, false),
    ("position: (1e9, 0.5, 0), look_at: (0.5, 0.5, 0), fov_y: 0.01", false, false),
    ("position: (1e9, 0.5, 0), look_at: (2e9, 0.5, 0)", true, true),
    // Below the picture, unless the lens is moved down, or blurs what is beyond its edge.
    ("position: (0.5, 3.5, 5), look_at: (0.5, 3.5, 0)", false, true),
    ("position: (0.5, 3.5, 5), look_at: (0.5, 3.5, 0), shift: (0, 0.3)", false, true),
    ("position: (0.5, 3.5, 5), look_at: (0.5, 3.5, 0), shift: (0, -0.3)", false, false),
    ("position: (0.5, 3.5, 5), look_at: (0.5, 3.5, 0), aperture: 1", false, true),
    ("position: (0.5, 3.5, 5), look_at: (0.5, 3.5, 0), aperture: 1, focus: Distance(2)", false, false),
];

#[test]
fn what_the_camera_has_behind_it_is_told_and_what_is_out_of_its_view_by_check() {
    for (camera, behind, outside) in CAMERAS {
        let scene = format!("(models: [(path: \"m.obj\")],\n cameras: {{ \"main\": ({camera}) }})");
        let files = Files::new(SQUARE, "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n", &scene);
        let said = files.unseen("s.ron");
        assert_eq!(said.len(), usize::from(*behind), "{camera}: {said:?}");
        let checked = files.checked();
        assert_eq!(checked.len(), usize::from(*outside), "{camera}: {checked:?}");
        assert!(said.iter().chain(&checked).all(|text| text.contains(UNSEEN) && text.contains("`main`")), "{said:?}");
    }
    // Each camera is checked; that which is rendered by sees it.
    let scene = "(models: [(path: \"m.obj\")], camera: \"good\", cameras: {\n \"bad\": (position: (0, 0, 5), look_at: (0, 0, 9)),
        \"good\": (position: (0, 0, 5), look_at: (0, 0, 0)), })";
    let files = Files::new(SQUARE, "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n", scene);
    assert_eq!(files.unseen("s.ron"), [""; 0]);
    let checked = files.checked();
    assert!(checked.len() == 1 && checked[0].contains("`bad`"), "{checked:?}");
}
