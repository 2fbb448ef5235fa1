//! Values of scene files that a command line changes.

use std::path::Path;

use glam::{UVec2, Vec3};
use lucerna::components::{Energy, Environment, Film, Tone};

use super::{SCENE, load_text};

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
        ("models[0].transform.scale", "(1, 1, 1)"),
        ("cameras.top.fov_y", "10"),
        ("film.crop", "None"),
    ];
    let scene = load_text(SCENE, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
    assert_eq!(scene.materials["square:red"].ns, 64.0);
    assert_eq!(scene.materials["square:red"].kd, Vec3::X);
    assert_eq!(scene.film, Film { size: UVec2::new(256, 128), crop: None, exposure: 1.5, tone: Tone::None });
    assert_eq!(scene.active, "top");
    assert_eq!((scene.render.spp, scene.render.energy), (16, Energy::Preserve));
    assert_eq!(scene.environment, Some(Environment::Constant(Vec3::ZERO)));
    assert_eq!(scene.cameras["top"].fov_y, 10.0);
    let determinant = scene.meshes["square/square/0"].transform.0.matrix3.determinant();
    assert!((determinant - 1.0).abs() < 1e-12);
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
        ("models[7].path", "1", 8, "none of the items 0 to 0"),
        ("models[x].path", "1", 8, "expected a number in brackets"),
        ("models[0]path", "1", 10, "expected `.`"),
        ("models[0", "1", 7, "expected `.`"),
        ("cameras.tpo.fov_y", "20", 9, "there is no `cameras.tpo` to change\n    help: did you mean `top`?"),
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
fn a_define_of_endless_parts_is_an_error() {
    for path in [["a"; 100_000].join("."), "a".to_owned() + &"[0]".repeat(100_000)] {
        let errors = load_text("()", &[(&path, "1")]).unwrap_err();
        assert!(errors.to_string().contains("levels deep"), "another error");
    }
}

/// By its parts, a camera may also be made.
#[test]
fn a_camera_of_a_name_like_another_may_be_made_by_its_parts() {
    let parts = [("cameras.topp.position", "(0, 9, 0)"), ("cameras.topp.look_at", "(1, 0, 0)")];
    let scene = load_text(SCENE, &parts).unwrap_or_else(|errors| panic!("{errors}")).description;
    assert_eq!(scene.cameras["topp"].position.y, 9.0);
}
