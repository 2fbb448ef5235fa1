//! Where a value belongs: materials by name, by model or both; files that extend others; what can't be written.

use glam::{DVec3, Vec3};
use lucerna::components::{PointLight, ShaderValue};
use lucerna::scene::edit::edit;
use lucerna::scene::{Assets, SceneDescription};

use super::{edited, folder, read};

const TWO: &str = "models: [(path: \"square.obj\", name: \"a\"), (path: \"square.obj\", name: \"b\", materials: { \"red\": (ns: 5) })]";

/// Edits a scene of two squares; `TWO` stands for its models. Returns the new text.
#[track_caller]
fn two(text: &str, change: impl FnOnce(&mut SceneDescription)) -> String {
    let folder = folder(&[("s.ron", &text.replace("TWO", TWO))]);
    let text = edited(&folder.path().join("s.ron"), change).1.text;
    text.replace(TWO, "TWO")
}

fn material<'s>(scene: &'s mut SceneDescription, name: &str) -> &'s mut lucerna::scene::MtlMaterial {
    scene.materials.get_mut(name).expect("a material")
}

#[test]
fn a_material_is_changed_by_its_name_where_all_of_that_name_agree() {
    let both = |scene: &mut SceneDescription| ["a:red", "b:red"].iter().for_each(|name| material(scene, name).pm = 0.5);
    assert_eq!(two("(TWO)", both), "(TWO, materials: { \"red\": (pm: 0.5) })");
    let one = |scene: &mut SceneDescription| material(scene, "a:red").pm = 0.5;
    assert_eq!(two("(TWO)", one), "(TWO, materials: { \"a:red\": (pm: 0.5) })");
    // What a model says of its own counts over that: the value goes there.
    let own = |scene: &mut SceneDescription| material(scene, "b:red").ns = 7.0;
    assert_eq!(two("(TWO)", own), format!("({})", TWO.replace("ns: 5", "ns: 7")));
    let full = "(TWO, materials: { \"b:red\": (ns: 6), \"red\": (ns: 1) })";
    assert_eq!(two(full, own), full.replace("ns: 6", "ns: 7"));
    // The other model has its own, so the name may be changed for the first.
    let first = |scene: &mut SceneDescription| material(scene, "a:red").ns = 9.0;
    assert_eq!(two("(TWO, materials: { \"red\": (ns: 1) })", first), "(TWO, materials: { \"red\": (ns: 9) })");
}

#[test]
fn names_that_need_quotes_are_written_and_read() {
    let odd = |scene: &mut SceneDescription| material(scene, "a:my.mat \"x\"").kd = Vec3::splat(0.25);
    assert_eq!(two("(TWO)", odd), "(TWO, materials: { \"a:my.mat \\\"x\\\"\": (kd: 0.25) })");
    let text = "(TWO, materials: { r#\"my.mat \"x\"\"#: (kd: 1) }, cameras: { \"a.b c\": (position: (0, 0, 1), look_at: (0, 0, 0)) })";
    let new = two(text, |scene| {
        ["a", "b"].iter().for_each(|model| material(scene, &format!("{model}:my.mat \"x\"")).kd = Vec3::splat(0.5));
        scene.cameras.get_mut("a.b c").expect("a camera").fov_y = 33.3;
    });
    assert_eq!(new, text.replace("kd: 1", "kd: 0.5").replace("(0, 0, 0))", "(0, 0, 0), fov_y: 33.3)"));
}

#[test]
fn what_the_library_gives_becomes_an_override_and_a_roughness_can_be_taken_away() {
    let rough =
        |scene: &mut SceneDescription| ["a:red", "b:red"].iter().for_each(|name| material(scene, name).pr = None);
    assert_eq!(two("(TWO)", rough), "(TWO, materials: { \"red\": (pr: None) })");
}

const BASE: &str = r#"(
    models: [(path: "square.obj")],
    cameras: { "front": (position: (0, 0, 5), look_at: (0, 0, 0), aperture: 0.5), "side": (position: (5, 0, 0), look_at: (0, 0, 0)) },
    camera: "front",
    lights: { "lamp": Spot(position: (0, 2, 0), look_at: (0, 0, 0), intensity: 9) },
    environment: Sky(sun: (45, 0), turbidity: 2),
    materials: { "square:red": (kd: 0.5), "red": (ns: 3) },
    shader: { "A": 1, "B": 2 },
)"#;

#[test]
fn a_file_that_extends_another_has_only_what_it_says_otherwise() {
    let folder =
        folder(&[("base.ron", BASE), ("s.ron", "(\n    extends: \"base.ron\",\n    film: (exposure: 1),\n)\n")]);
    let (_, edited) = edited(&folder.path().join("s.ron"), |scene| {
        let camera = scene.cameras.get_mut("front").expect("a camera");
        (camera.position.z, camera.lens.aperture) = (6.0, 0.0);
        scene.active = "side".into();
        let PointLight { intensity, cone, .. } = scene.lights.get_mut("lamp").expect("a light");
        (*intensity, cone.as_mut().expect("a spot").angle) = (Vec3::new(1.0, 2.0, 3.0), 60.0);
        if let Some(lucerna::components::Environment::Daylight(day)) = &mut scene.environment {
            day.elevation = 10.5;
        }
        (material(scene, "square:red").kd, material(scene, "square:red").ns) = (Vec3::ONE, 4.0);
        scene.film.exposure = 2.0;
        scene.render.max_depth = 5;
        scene.shader.0.remove("A");
        scene.shader.0.insert("B".into(), ShaderValue::Switch(false));
    });
    assert_eq!(
        edited.text,
        r#"(
    extends: "base.ron",
    film: (exposure: 2),
    cameras: {
        "front": (position: (0, 0, 6), aperture: 0),
    },
    camera: "side",
    lights: {
        "lamp": Spot(intensity: (1, 2, 3), angle: 60),
    },
    render: (max_depth: 5),
    environment: Sky(sun: (10.5, 0)),
    materials: {
        "square:red": (kd: 1),
        "red": (ns: 4),
    },
    shader: {
        "B": false,
        "A": None,
    },
)
"#
    );
    assert_eq!(edited.summary(), "1 value changed, 11 added (camera, cameras.front, environment.sun, ..)");
}

#[test]
fn what_would_not_be_read_is_refused_and_what_is_taken_away_is_left_out() {
    let text = "(models: [(path: \"square.obj\")], lights: { \"lamp\": Spot(position: (0, 2, 0), look_at: (0, 0, 0), intensity: 9) }, film: None)";
    let folder = folder(&[("s.ron", text)]);
    let (before, text) = read(&folder.path().join("s.ron"), &Assets::new());
    let mut after = before.clone();
    after.lights.get_mut("lamp").expect("a light").position = DVec3::ZERO;
    let error = edit(&text, &before, &after).expect_err("a light without an axis");
    assert!(error.to_string().contains("`position` and `look_at` are the same point: nothing was saved"), "{error}");

    let mut after = before.clone();
    (after.film.exposure, after.render.seed) = (1.0, 3);
    let edited = edit(&text, &before, &after).expect("an edit");
    assert_eq!((edited.changed, edited.added), (0, 1));
    let told = edited.left_out[0].to_string();
    assert!(
        told.contains("s.ron:1:") && told.contains("`film` is taken away here") && told.contains("help: "),
        "{told}"
    );
}

#[test]
fn values_with_keys_are_written_and_told_with_the_place_of_their_keys() {
    let text = "(models: [(path: \"square.obj\")], cameras: { \"front\": (position: (0, 0, 5), look_at: (0, 0, 0)) },\n animate: (frames: 9, keys: { \"cameras.front.position\": { 0: (0, 0, 5), 8: (0, 0, 9) } }))";
    let folder = folder(&[("s.ron", text)]);
    let (_, edited) = edited(&folder.path().join("s.ron"), |scene| {
        scene.cameras.get_mut("front").expect("a camera").position.x = 1.0
    });
    assert!(edited.text.contains("\"front\": (position: (1, 0, 5)"), "{}", edited.text);
    let note = edited.notes[0].to_string();
    assert!(note.contains("s.ron:2:") && note.contains("`cameras.front.position` has keys"), "{note}");
}

#[test]
fn lights_are_added_taken_away_and_made_spots() {
    let text = "(models: [(path: \"square.obj\")], lights: { \"a\": Point(position: (0, 2, 0), intensity: 9), \"b\": Point(position: (0, 3, 0), intensity: 1) })";
    let folder = folder(&[("s.ron", text)]);
    let (_, edited) = edited(&folder.path().join("s.ron"), |scene| {
        scene.lights.remove("b");
        let a = scene.lights.get_mut("a").expect("a light");
        let cone = lucerna::components::SpotCone { look_at: DVec3::X, angle: 30.0, blend: 0.5 };
        a.cone = Some(cone);
        let c = *a;
        scene.lights.insert("c".into(), c);
    });
    assert!(edited.text.contains("\"b\": None"), "{}", edited.text);
    assert_eq!(
        edited
            .text
            .matches("Spot(position: (0, 2, 0), intensity: 9, look_at: (1, 0, 0), angle: 30, blend: 0.5)")
            .count(),
        2,
        "{}",
        edited.text
    );
}
