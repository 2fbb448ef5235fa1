//! Odd layouts: a file in one line, comments anywhere, commas that lack, blocks that are empty.

use std::path::PathBuf;

use glam::{DVec3, Vec3};
use lucerna::components::ShaderValue;
use lucerna::scene::SceneDescription;
use lucerna::scene::settings::Settings;

use super::{edited, folder};

/// Edits a scene file of a text; `MODELS` stands for its models. Returns the new text.
#[track_caller]
fn after(text: &str, change: impl FnOnce(&mut SceneDescription)) -> String {
    let models = "models: [(path: \"square.obj\")]";
    let folder = folder(&[("s.ron", &text.replace("MODELS", models))]);
    let path: PathBuf = folder.path().join("s.ron");
    edited(&path, change).1.text.replace(models, "MODELS")
}

fn red(scene: &mut SceneDescription) -> &mut lucerna::scene::MtlMaterial {
    scene.materials.get_mut("square:red").expect("a material")
}

#[test]
fn a_value_is_added_as_it_would_be_written_by_hand() {
    let exposure = |scene: &mut SceneDescription| scene.film.exposure = 0.1;
    for (text, wanted) in [
        ("(MODELS)", "(MODELS, film: (exposure: 0.1))"),
        ("(MODELS,)", "(MODELS, film: (exposure: 0.1),)"),
        ("Scene(MODELS)", "Scene(MODELS, film: (exposure: 0.1))"),
        ("(MODELS, film: ())", "(MODELS, film: (exposure: 0.1))"),
        ("(MODELS, film: ( /* none */ ))", "(MODELS, film: (exposure: 0.1 /* none */ ))"),
        ("(MODELS, film: (tone: Agx /* x */))", "(MODELS, film: (tone: Agx, exposure: 0.1 /* x */))"),
        ("(\n    MODELS,\n)", "(\n    MODELS,\n    film: (exposure: 0.1),\n)"),
        ("(\n\tMODELS\n)\n", "(\n\tMODELS,\n\tfilm: (exposure: 0.1),\n)\n"),
        ("(\n  MODELS // which\n  // the end\n)", "(\n  MODELS, // which\n  film: (exposure: 0.1),\n  // the end\n)"),
        ("(\n  MODELS /* , */ , // which\n)", "(\n  MODELS /* , */ , // which\n  film: (exposure: 0.1),\n)"),
        ("(MODELS,\n film: (\n  // nothing\n ))", "(MODELS,\n film: (\n  // nothing\n  exposure: 0.1,\n ))"),
        ("(MODELS, film: (tone: Agx // x, y\n))", "(MODELS, film: (tone: Agx, // x, y\n    exposure: 0.1,\n))"),
        ("(MODELS, film: (exposure: 3))", "(MODELS, film: (exposure: 0.1))"),
        ("(MODELS, film: (exposure: /* stops */ 3 // x\n))", "(MODELS, film: (exposure: /* stops */ 0.1 // x\n))"),
        (
            "// ) film: (exposure: 1\n(MODELS)\n// end\n",
            "// ) film: (exposure: 1\n(MODELS, film: (exposure: 0.1))\n// end\n",
        ),
    ] {
        assert_eq!(after(text, exposure), wanted, "{text}");
    }
}

#[test]
fn entries_of_maps_have_lines_of_their_own_where_fields_do() {
    let both = |scene: &mut SceneDescription| {
        red(scene).kd = Vec3::new(0.25, 0.5, 0.75);
        scene.shader.0.insert("A".into(), ShaderValue::Switch(true));
        scene.shader.0.insert("B \" 2".into(), ShaderValue::Number(-1.5e-9));
    };
    let one_line =
        "(MODELS, materials: { \"red\": (kd: (0.25, 0.5, 0.75)) }, shader: { \"A\": true, \"B \\\" 2\": -1.5e-9 })";
    assert_eq!(after("(MODELS)", both), one_line);
    let lines = "(\n  MODELS,\n  materials: {\n    \"red\": (kd: (0.25, 0.5, 0.75)),\n  },\n  shader: {\n    \"A\": true,\n    \"B \\\" 2\": -1.5e-9,\n  },\n)";
    assert_eq!(after("(\n  MODELS,\n)", both), lines);
    assert_eq!(
        after("(\n MODELS,\n materials: {\n  // \"red\": (kd: 1),\n },\n shader: {},\n)", both),
        "(\n MODELS,\n materials: {\n  // \"red\": (kd: 1),\n  \"red\": (kd: (0.25, 0.5, 0.75)),\n },\n shader: { \"A\": true, \"B \\\" 2\": -1.5e-9 },\n)"
    );
}

#[test]
fn of_a_tuple_only_what_differs_is_exchanged() {
    let green = |scene: &mut SceneDescription| red(scene).kd.y = 0.125;
    let text = "(MODELS, materials: { \"red\": (kd: (/* r */ 8e-1, /* g */ 0.10, /* b */ 1.0)) })";
    assert_eq!(after(text, green), text.replace("0.10", "0.125"));
    // A grey is one number where one is written, and stays three where three are.
    let grey = |scene: &mut SceneDescription| red(scene).kd = Vec3::splat(0.5);
    assert_eq!(after("(MODELS, materials: { \"red\": (kd: 1) })", grey), "(MODELS, materials: { \"red\": (kd: 0.5) })");
    assert_eq!(
        after("(MODELS, materials: { \"red\": (kd: (1, 1, 0.50)) })", grey),
        "(MODELS, materials: { \"red\": (kd: (0.5, 0.5, 0.50)) })"
    );
}

#[test]
fn comments_of_a_value_that_gives_way_stay_behind_it() {
    let text = "(MODELS, materials: { \"red\": (kd: (1, // red */\n 1 /* green */, 0.5)) })";
    let folder = folder(&[("s.ron", &text.replace("MODELS", "models: [(path: \"square.obj\")]"))]);
    let (_, edited) = edited(&folder.path().join("s.ron"), |scene| red(scene).kd = Vec3::new(0.5, 1.0, 0.5));
    assert!(edited.text.contains("(0.5, // red */\n 1 /* green */, 0.5)"), "{}", edited.text);
    let text = "(MODELS, environment: Constant(0.5 /* dim */), cameras: { \"a\": (position: (0, 0, 3), look_at: (0, 0, 0), focus: At((0, 0, 1 // here\n))) })";
    let new =
        after(text, |scene| scene.cameras.get_mut("a").expect("a").lens.focus = lucerna::components::Focus::LookAt);
    assert!(new.contains("focus: LookAt /* here */)"), "{new}");
}

#[test]
fn a_scene_without_cameras_gets_the_one_that_is_seen_through() {
    let new = after("(\n    MODELS,\n)\n", |scene| {
        scene.cameras.get_mut("default").expect("default").position = DVec3::new(1.0, 2.0, 3.5)
    });
    assert!(new.contains("\n    cameras: {\n        \"default\": (position: (1, 2, 3.5), look_at: ("), "{new}");
    assert!(new.contains("fov_y: 40),\n    },\n)"), "{new}");
}

#[test]
fn a_setting_alone_is_told_apart_by_its_table() {
    let a = Settings::default();
    let mut b = a;
    b.render.seed = 9;
    let differ: Vec<&str> =
        lucerna::scene::settings::SETTINGS.iter().filter(|s| !s.is_same(&a, &b)).map(|s| s.field).collect();
    assert_eq!(differ, ["seed"]);
}
