//! Scene files: loading, defines, finding, applying.

use std::path::{Path, PathBuf};

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{
    Active, Camera, Energy, Environment, Film, Geometry, Lobe, Material, Name, Passage, Render, Transform, UsesMaterial,
};
use lucerna::scene::{Define, Diagnostics, Loaded, MtlMaterial, SceneDescription, apply, check, describe, find, load};

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

#[test]
fn every_field_arrives() {
    let loaded = load_text(SCENE, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let names: Vec<_> = loaded.files.iter().map(|file| file.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["scene.ron", "square.obj", "square.mtl"]);
    let scene = loaded.description;
    assert_eq!(scene.name, "scene");
    assert_eq!(scene.active, "front");
    assert_eq!(scene.cameras["front"].fov_y, 30.0);
    assert_eq!(scene.cameras["top"].up, DVec3::NEG_Z);
    assert_eq!(scene.cameras["front"].up, DVec3::Y);
    assert_eq!(scene.film.size, UVec2::new(64, 32));
    assert_eq!(scene.film.window().min, UVec2::new(0, 4));
    assert_eq!(scene.film.window().max, UVec2::new(16, 8));
    assert_eq!(scene.film.exposure, 1.5);
    assert_eq!(scene.render.max_depth, 4);
    assert!(!scene.render.roulette);
    assert_eq!(scene.render.energy, Energy::AsWritten);
    assert_eq!((scene.render.seed, scene.render.spp), (7, 8));
    assert_eq!(scene.environment, Some(Environment::Constant(Vec3::new(0.5, 0.25, 1.0))));
    let material = &scene.materials["square:red"];
    assert_eq!((material.kd, material.ks, material.ns), (Vec3::new(0.8, 0.1, 0.1), Vec3::splat(0.5), 32.0));
    let mesh = &scene.meshes["square/square/0"];
    assert_eq!(mesh.material, "square:red");
    // Scaled by 2, turned by 90 degrees about z, moved: (1, 0, 0) -> (0, 2, 0) -> (1, 4, 3).
    let corner = mesh.transform.0.transform_point3(DVec3::X);
    assert!((corner - DVec3::new(1.0, 4.0, 3.0)).length() < 1e-12, "{corner}");
}

#[test]
fn an_obj_file_is_a_scene_of_its_own() {
    let folder = folder(&[("square.obj", SQUARE), ("square.mtl", SQUARE_MTL)]);
    let defines = [Define::given("render.spp", "3")];
    let scene = load(&folder.path().join("square.obj"), &defines).unwrap().description;
    assert_eq!(scene.name, "square");
    assert!(matches!(scene.environment, Some(Environment::Daylight(_))));
    assert_eq!(scene.render.spp, 3);
}

#[test]
fn defines_change_fields_by_path() {
    let defines = [
        ("materials.red.ns", "64"),
        ("materials.\"square:red\".kd", "(1, 0, 0)"),
        ("film.size", "(256, 128)"),
        ("camera", "top"),
        ("render.spp", "16"),
        ("render.energy", "Preserve"),
        ("environment", "Constant(0)"),
        ("models.0.transform.scale", "(1, 1, 1)"),
        ("cameras.top.fov_y", "10"),
        ("film.crop", "None"),
    ];
    let scene = load_text(SCENE, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
    assert_eq!(scene.materials["square:red"].ns, 64.0);
    assert_eq!(scene.materials["square:red"].kd, Vec3::X);
    assert_eq!(scene.film, Film { size: UVec2::new(256, 128), crop: None, exposure: 1.5 });
    assert_eq!(scene.active, "top");
    assert_eq!((scene.render.spp, scene.render.energy), (16, Energy::Preserve));
    assert_eq!(scene.environment, Some(Environment::Constant(Vec3::ZERO)));
    assert_eq!(scene.cameras["top"].fov_y, 10.0);
    let determinant = scene.meshes["square/square/0"].transform.0.matrix3.determinant();
    assert!((determinant - 1.0).abs() < 1e-12);
}

#[test]
fn models_of_one_name_are_told_apart_and_share_their_geometry() {
    let text = r#"(models: [(path: "square.obj"), (path: "square.obj"), (path: "square.obj", name: "third")])"#;
    let scene = description(text);
    let names: Vec<&str> = scene.meshes.keys().map(String::as_str).collect();
    assert_eq!(names, ["square-2/square/0", "square/square/0", "third/square/0"]);
    let geometry = |name: &str| scene.meshes[name].geometry.clone();
    assert!(std::sync::Arc::ptr_eq(&geometry(names[0]), &geometry(names[2])));
    assert_eq!(scene.materials.len(), 3);
}

/// What is wrong, where it is reported, and a part of the message.
const WRONG: &[(&str, u32, u32, &str)] = &[
    ("(film: (sise: (1, 1)))", 1, 9, "unknown field `film.sise`"),
    ("(film: (size: (0, 1)))", 1, 15, "film.size: expected a whole number from 1 to 16384"),
    ("(film: (size: (8, 8), crop: (0, 9, 0, 8)))", 1, 29, "x1 <= 8"),
    ("(film: (size: (8, 8, 8)))", 1, 15, "expected 2 whole numbers in parentheses, found 3 values"),
    ("(film: 3)", 1, 8, "film: expected fields, as in (name: value), found `3`"),
    ("(\n  render: (spp: -1),\n)", 2, 17, "render.spp: expected a whole number"),
    ("(render: (spp: 1.5))", 1, 16, "render.spp"),
    ("(render: (integrator: Bdpt))", 1, 23, "expected Path or Bsdf, found `Bdpt`"),
    ("(render: (energy: preserve))", 1, 19, "expected Preserve or AsWritten"),
    ("(render: (roulette: 1))", 1, 21, "true or false"),
    ("(environment: Map(path: \"a.exr\"))", 1, 25, "can't use `"),
    ("(environment: Map(strength: 2))", 1, 18, "path"),
    ("(environment: Constant((1, 2)))", 1, 15, "expected 3 numbers"),
    ("(environment: Constant(NaN))", 1, 15, "found `NaN`"),
    ("(environment: Constant(-1))", 1, 15, "from 0 to"),
    ("(cameras: { \"a\": (position: (0, 0, 0)) })", 1, 18, "cameras.a: the field `look_at` is missing"),
    ("(cameras: { \"a\": (position: (0, 0, 0), look_at: (0, 0, 0)) })", 1, 18, "the same point"),
    ("(cameras: { \"a\": (position: (0, 1, 0), look_at: (0, 0, 0)) })", 1, 18, "along the view"),
    ("(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), fov_y: 180) })", 1, 67, "fov_y"),
    ("(cameras: { \"a\": (position: (0, 0, inf), look_at: (0, 0, 0)) })", 1, 29, "found `inf`"),
    (
        "(cameras: { \"front\": (position: (0, 0, 1), look_at: (0, 0, 0)) }, camera: \"fornt\")",
        1,
        75,
        "did you mean `front`",
    ),
    ("(camera: \"front\")", 1, 10, "there is no camera `front`; known here: default"),
    ("(models: [(path: \"nothing.obj\")])", 1, 18, "there is no file"),
    ("(models: [(path: \"square.obj\"), (path: \"square.obj\", name: \"square\")])", 1, 40, "is named `square` too"),
    ("(models: [(path: \"scene.ron\")])", 1, 18, "is no .obj file"),
    ("(models: [(name: \"a\")])", 1, 11, "the field `path` is missing"),
    ("(models: [(path: \"square.obj\", transform: (scale: 0))])", 1, 43, "flattens"),
    ("(models: [(path: \"square.obj\", transform: (scale: (1, 1))))])", 1, 0, ""),
    ("(models: [(path: \"square.obj\", transform: (translate: (1e12, 0, 0), scale: 1e9))])", 1, 18, "reaches beyond"),
    ("(models: [(path: \"square.obj\")], materials: { \"rde\": (ns: 1) })", 1, 54, "no model has a material `rde`"),
    ("(models: [(path: \"square.obj\")], materials: { \"red\": (shininess: 1) })", 1, 55, "materials.red.shininess"),
    ("(materials: { \"red\": (ns: 1e9) })", 1, 27, "materials.red.ns: expected a number from 0 to 100000"),
    ("(film: (), film: ())", 1, 12, "given twice"),
    ("(film: (size: (1, 1))", 1, 22, "expected"),
    ("", 1, 1, "unexpected end"),
    ("(film: (size: (1, \"a\")))", 1, 15, "found `\"a\"`"),
];

#[test]
fn wrong_scene_files_are_reported_where_they_are_wrong() {
    for (text, line, column, message) in WRONG {
        let Err(errors) = load_text(text, &[]) else { panic!("taken: {text}") };
        let found = &errors.list[0];
        assert!(found.to_string().contains(message), "{text}\n{found}");
        if *column > 0 {
            assert_eq!((found.line, found.column), (*line, *column), "{text}\n{found}");
        }
        assert!(found.file.ends_with("scene.ron"));
    }
}

#[test]
fn materials_that_are_not_rendered_as_asked_are_warned_of() {
    let text = "(models: [(path: \"square.obj\")], materials: { \"red\": (d: 0.5, tf: (1, 1, 0.5), illum: 10) })";
    let loaded = load_text(text, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let places: Vec<u32> = loaded.warnings.iter().map(|warning| warning.column).collect();
    assert_eq!(places, [87], "{:?}", loaded.warnings);
    assert!(loaded.warnings[0].message.contains("shadow catcher"));
}

#[test]
fn every_number_of_a_material_can_be_changed() {
    let text = "(models: [(path: \"square.obj\")], materials: { \"red\": (pr: 0.25, pm: 0.5, d: 0.75, ni: 1.5, tf: 0.5, \
                illum: 7) })";
    let loaded = load_text(text, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let red = &loaded.description.materials["square:red"];
    assert_eq!((red.pr, red.pm, red.d, red.ni, red.illum), (Some(0.25), 0.5, 0.75, 1.5, 7));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn an_illum_in_a_scene_file_is_held_to_the_same_numbers() {
    for (edit, passage) in [
        ("illum: 4", Passage::Opaque),
        ("illum: 7, tf: 1, ni: 1", Passage::Opaque),
        ("illum: 7, d: 0.5", Passage::SeeThrough(0.5)),
        ("illum: 4, ni: 1.5", Passage::Glass(1.5)),
        ("illum: 9, tf: (0.5, 1, 1)", Passage::Glass(1.0)),
    ] {
        let text = format!("(models: [(path: \"square.obj\")], materials: {{ \"red\": ({edit}) }})");
        let loaded = load_text(&text, &[]).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(loaded.description.materials["square:red"].passage(), passage, "{edit}");
        let told = loaded.warnings.iter().filter(|warning| warning.message.contains("alone makes no glass")).count();
        assert_eq!(told, usize::from(!matches!(passage, Passage::Glass(_))), "{edit}: {:?}", loaded.warnings);
    }
}

#[test]
fn thin_makes_a_pane_of_glass_and_of_nothing_else() {
    for (edit, passage, told) in [
        ("thin: true, illum: 4, ni: 1.5", Passage::Pane(1.5), 0),
        ("thin: false, illum: 4, ni: 1.5", Passage::Glass(1.5), 0),
        ("thin: true, illum: 7, tf: (0.5, 1, 1)", Passage::Pane(1.0), 0),
        ("thin: true", Passage::Opaque, 1),
        ("thin: true, d: 0.5", Passage::SeeThrough(0.5), 1),
    ] {
        let text = format!("(models: [(path: \"square.obj\")], materials: {{ \"red\": ({edit}) }})");
        let loaded = load_text(&text, &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let material = &loaded.description.materials["square:red"];
        assert_eq!(material.passage(), passage, "{edit}");
        assert_eq!(material.appearance().kind == "pane", matches!(passage, Passage::Pane(_)), "{edit}");
        let found = loaded.warnings.iter().filter(|warning| warning.message.contains("makes no pane")).count();
        assert_eq!(found, told, "{edit}: {:?}", loaded.warnings);
    }
}

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
fn wrong_defines_are_named() {
    let wrong = [
        ("materials.red.ns", "abc", 18, "materials.red.ns: expected a number, found `abc`"),
        ("materials.red.nss", "1", 15, "unknown field `materials.red.nss`"),
        ("materials.rde.ns", "1", 11, "no model has a material `rde`"),
        ("flim.size", "(1, 1)", 1, "did you mean `film`"),
        ("camera.x", "1", 8, "in the define `camera.x`: there is no field `x`"),
        ("models.7.path", "1", 8, "none of the items 0 to 0"),
        ("film.size", "(1, ", 15, "in the define `film.size`"),
        ("", "1", 1, "is no field path"),
        ("film..size", "1", 6, "is no field path"),
    ];
    for (path, value, column, message) in wrong {
        let Err(errors) = load_text(SCENE, &[(path, value)]) else { panic!("taken: {path}={value}") };
        let found = &errors.list[0];
        assert!(found.to_string().contains(message), "{path}\n{found}");
        assert_eq!((found.file.as_path(), found.line, found.column), (Path::new("-D"), 1, column), "{found}");
    }
}

#[test]
fn all_errors_of_a_scene_are_reported_at_once() {
    let errors = load_text("(film: (size: 1), render: (spp: 0), flim: 1)", &[]).unwrap_err();
    let places: Vec<u32> = errors.list.iter().map(|error| error.column).collect();
    assert_eq!(places, [15, 33, 37], "{errors}");
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

/// Entities with a component that changed since the last call.
fn changes<T: Component>(world: &mut World) -> usize {
    let mut query = world.query_filtered::<Entity, Or<(Changed<T>, Added<T>)>>();
    query.iter(world).count()
}

fn all_changes(world: &mut World) -> [usize; 10] {
    let counts = [
        changes::<Name>(world),
        changes::<Geometry>(world),
        changes::<Transform>(world),
        changes::<UsesMaterial>(world),
        changes::<Material>(world),
        changes::<Camera>(world),
        changes::<Active>(world),
        changes::<Film>(world),
        changes::<Render>(world),
        changes::<Environment>(world),
    ];
    world.clear_trackers();
    counts
}

#[test]
fn applying_changes_what_differs_and_nothing_else() {
    let mut world = World::new();
    let scene = description(SCENE);
    apply(&mut world, &scene);
    // Names: mesh, material, two cameras, film, environment.
    assert_eq!(all_changes(&mut world), [6, 1, 1, 1, 1, 2, 1, 1, 1, 1]);
    apply(&mut world, &scene);
    assert_eq!(all_changes(&mut world), [0; 10], "the same description");
    apply(&mut world, &description(SCENE));
    assert_eq!(all_changes(&mut world), [0; 10], "an equal description read again");

    let mut edited = scene.clone();
    edited.materials.get_mut("square:red").unwrap().ns = 1.0;
    apply(&mut world, &edited);
    assert_eq!(all_changes(&mut world), [0, 0, 0, 0, 1, 0, 0, 0, 0, 0]);
    edited.active = "top".into();
    apply(&mut world, &edited);
    assert_eq!(all_changes(&mut world), [0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
    let mut actives = world.query_filtered::<&Name, With<Active>>();
    assert_eq!(actives.iter(&world).map(Name::as_str).collect::<Vec<_>>(), ["top"]);
    edited.environment = None;
    edited.render.spp = 9;
    apply(&mut world, &edited);
    assert_eq!(all_changes(&mut world), [0, 0, 0, 0, 0, 0, 0, 0, 1, 0]);
    assert_eq!(world.query::<&Environment>().iter(&world).count(), 0);
}

#[test]
fn what_files_say_of_a_material_stays_beside_what_it_comes_to() {
    let edited = |edit: &str| description(&SCENE.replace("(ns: 32, ks: 0.5)", edit));
    let mut world = World::new();
    let mirror = edited("(ns: 32, ks: 0.5, illum: 3)");
    apply(&mut world, &mirror);
    assert_eq!(describe(&world, &mirror.name), mirror);
    let numbers = world.query::<(&MtlMaterial, &Material)>().single(&world).unwrap();
    assert_eq!((numbers.0.ns, numbers.1.lobe), (32.0, Lobe::Mirror));
    // So another `illum` finds its exponent again.
    apply(&mut world, &edited("(ns: 32, ks: 0.5, illum: 2)"));
    assert_eq!(world.query::<&Material>().single(&world).unwrap().lobe, Lobe::Phong(32.0));
    // A material that was edited by itself is described as it is.
    world.query::<&mut Material>().single_mut(&mut world).unwrap().lobe = Lobe::Ggx(0.5);
    let described = describe(&world, &mirror.name);
    assert_eq!(described.materials["square:red"].pr, Some(0.5));
    let mut other = World::new();
    apply(&mut other, &described);
    assert_eq!(other.query::<&Material>().single(&other).unwrap(), world.query::<&Material>().single(&world).unwrap());
}

#[test]
fn applying_another_scene_leaves_nothing_of_the_first() {
    let mut world = World::new();
    apply(&mut world, &description(SCENE));
    let kept = world.query_filtered::<Entity, With<Film>>().single(&world).unwrap();
    world.spawn((Name::new("stray"), Material::default()));
    world.spawn((Name::new("unrelated"),));
    let other = description(r#"(models: [(path: "square.obj", name: "other")])"#);
    apply(&mut world, &other);
    let mut names: Vec<String> = world.query::<&Name>().iter(&world).map(|name| name.to_string()).collect();
    names.sort();
    assert_eq!(names, ["default", "film", "other/square/0", "other:red", "unrelated"]);
    assert_eq!(world.query_filtered::<Entity, With<Film>>().single(&world).unwrap(), kept);
    let used = world.query::<&UsesMaterial>().single(&world).unwrap().0;
    assert_eq!(world.get::<Name>(used).unwrap().as_str(), "other:red");
}

#[test]
fn a_define_of_endless_parts_is_an_error() {
    let path = ["a"; 100_000].join(".");
    let errors = load_text("()", &[(&path, "1")]).unwrap_err();
    assert!(errors.to_string().contains("levels deep"), "another error");
}
