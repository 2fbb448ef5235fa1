//! What scene files say arrives, or is told where it is wrong.

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Energy, Environment};
use lucerna::scene::{Define, load};

use super::{SCENE, SQUARE, SQUARE_MTL, description, folder, load_text};

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
fn a_comment_may_end_a_scene_file() {
    for text in [
        "(film: (size: (8, 9))) // end",
        "(film: (size: (8, 9)))\n// \"//\" (",
        "// http://a\n(film: (size: (8, 9)))//",
    ] {
        let loaded = load_text(text, &[]).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
        assert_eq!(loaded.description.film.size.to_array(), [8, 9], "{text}");
    }
}

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
fn all_errors_of_a_scene_are_reported_at_once() {
    let errors = load_text("(film: (size: 1), render: (spp: 0), flim: 1)", &[]).unwrap_err();
    let places: Vec<u32> = errors.list.iter().map(|error| error.column).collect();
    assert_eq!(places, [15, 33, 37], "{errors}");
}
