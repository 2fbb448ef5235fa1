//! Assets are found, told apart and checked.

use std::path::PathBuf;

use lucerna::scene::{check, find, load};

use super::{SCENE, SQUARE, SQUARE_MTL, folder};

#[test]
fn assets_are_known_by_their_content_where_their_ending_says_nothing() {
    let texts: &[(&str, &str, &str)] = &[
        ("model", "# made by hand\n\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ""),
        ("m.obj.txt", SQUARE, ""),
        ("M.OBJ", SQUARE, ""),
        ("m.wavefront", "\r\n\r\nvn 0 0 1\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", ""),
        ("scene", "// a scene\n(models: [(path: \"square.obj\")])", ""),
        ("scene.txt", "(models: [(path: \"square.obj\")])", ""),
        ("library", SQUARE_MTL, "library of materials"),
        ("m.glb", "glTF\u{2}\0\0\0", "this is a binary glTF model"),
        ("m.fbx", "Kaydara FBX Binary  \0", "this is an FBX model"),
        ("m.ply", "ply\nformat ascii 1.0\n", "this is a PLY model"),
        ("m.bin", "v 0 0 0\n\0\u{1}", "this is a binary file"),
        ("notes", "good evening\nv is a letter\n", "trailing characters"),
        ("empty", "", "unexpected end"),
    ];
    let folder = folder(&[("square.obj", SQUARE), ("square.mtl", SQUARE_MTL)]);
    for (name, text, refusal) in texts {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        match load(&path, &[]) {
            Ok(loaded) => assert!(refusal.is_empty() && loaded.description.meshes.len() == 1, "{name} was taken"),
            Err(errors) => {
                assert!(!refusal.is_empty() && errors.to_string().contains(refusal), "{name}: {errors}");
                assert_eq!(errors.list.len(), 1, "{errors}");
            }
        }
        // The same, as a scene's model.
        std::fs::write(folder.path().join("of.ron"), format!("(models: [(path: {name:?})])")).unwrap();
        let is_model = refusal.is_empty() && !text.contains("models");
        match load(&folder.path().join("of.ron"), &[]) {
            Ok(loaded) => assert!(is_model && !loaded.description.meshes.is_empty(), "{name} was taken"),
            Err(errors) => assert!(!is_model && errors.list.iter().all(|error| error.line == 1), "{name}: {errors}"),
        }
    }
    std::fs::write(folder.path().join("of.ron"), "(models: [(path: \"sqaure.obj\")])").unwrap();
    let errors = load(&folder.path().join("of.ron"), &[]).unwrap_err();
    assert!(errors.to_string().contains("did you mean `square.obj`"), "{errors}");
}

#[test]
fn check_says_what_each_material_is_taken_as() {
    let mtl = "newmtl red\nKd 0.8 0.1 0.1\nillum 4\nnewmtl clear\nNi 1.5\nillum 7\n";
    let folder = folder(&[("square.obj", SQUARE), ("square.mtl", mtl), ("scene.ron", SCENE)]);
    let table = |name: &str| -> Vec<(String, String, &str, String)> {
        let tables = check(&folder.path().join(name)).tables;
        let rows =
            tables.into_iter().flat_map(|table| table.rows.into_iter().map(move |row| (table.file.clone(), row)));
        rows.map(|(file, row)| {
            (file.file_name().unwrap().to_string_lossy().into_owned(), row.name, row.look.kind, row.look.reason)
        })
        .collect()
    };
    let red = "Kd 0.8 0.1 0.1; illum 4 alone makes no glass (Ni 1, Tf 1 1 1, d 1)".to_owned();
    let row = |file: &str, name: &str, kind, reason: &str| (file.to_owned(), name.to_owned(), kind, reason.to_owned());
    assert_eq!(table("square.obj"), [row("square.obj", "red", "diffuse", &red)]);
    assert_eq!(
        table("square.mtl"),
        [row("square.mtl", "clear", "glass", "illum 7, Ni 1.5"), row("square.mtl", "red", "diffuse", &red)]
    );
    // What a scene shows is told once, with what the scene changes.
    let glossy = "Kd 0.8 0.1 0.1, Ks 0.5 0.5 0.5, Ns 32; illum 4 alone makes no glass (Ni 1, Tf 1 1 1, d 1)";
    assert_eq!(table(""), [row("scene.ron", "square:red", "glossy", glossy)]);
}

#[test]
fn scenes_are_found_by_name_and_path() {
    let folder = folder(&[("a.ron", "()")]);
    let path = folder.path().join("a.ron");
    assert_eq!(find(path.to_str().unwrap()).unwrap(), path);
    let missing = find("no-such-scene-anywhere").unwrap_err();
    assert!(missing.to_string().contains("there is no scene `no-such-scene-anywhere`"), "{missing}");
    let missing = find("no/such/file.ron").unwrap_err();
    assert!(missing.to_string().contains("there is no such file"), "{missing}");
    assert!(find(folder.path().to_str().unwrap()).unwrap_err().to_string().contains("folder"));
}

#[test]
fn check_reads_folders_and_says_each_thing_once() {
    let folder = folder(&[
        ("a.ron", "(models: [(path: \"b.obj\")])"),
        ("b.obj", "v 0 0 nan\nf 1 1 1\n"),
        ("c.mtl", "newmtl a\nKdd 1 1 1\nKd 1 1 1\n"),
        ("notes.txt", "not an asset"),
    ]);
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    std::fs::write(folder.path().join("sub/d.ron"), "(flim: 1)").unwrap();
    let checked = check(folder.path());
    assert_eq!(checked.files.len(), 4);
    let found: Vec<String> = checked.diagnostics.list.iter().map(|found| found.to_string()).collect();
    assert_eq!(found.iter().filter(|found| found.contains("b.obj:1:7: error: a vertex can't be at NaN")).count(), 1);
    assert!(found.iter().any(|found| found.contains("c.mtl:2:1: warning: unknown statement `Kdd`")), "{found:?}");
    assert!(found.iter().any(|found| found.contains("d.ron:1:2: error: unknown field `flim`")), "{found:?}");
    let missing = check(&PathBuf::from("nothing.obj"));
    assert!(missing.diagnostics.has_errors());
    assert!(check(&folder.path().join("notes.txt")).diagnostics.has_errors());
    let odd = folder.path().join("odd.obj");
    std::fs::create_dir(&odd).unwrap();
    assert!(check(&odd).diagnostics.to_string().contains("this is a folder, not a file"));
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    assert!(check(&empty).diagnostics.to_string().contains("there is no asset in this folder"));
}
