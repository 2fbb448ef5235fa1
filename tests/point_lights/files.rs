//! Scene files with lights: what arrives, what is refused and where, and what is made of a model alone.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use lucerna::components::{PointLight, SpotCone};
use lucerna::scene::{Define, Diagnostics, Loaded, apply, describe, load};

const SCENE: &str = r#"(
    lights: {
        "bulb": Point(position: (1, 2, 3), intensity: (4, 5, 6)),
        "lamp": Spot(position: (0, 3, 0), look_at: (0, 0, 1), intensity: 10, angle: 30, blend: 0.5),
        "plain": Spot(position: (0, 3, 0), look_at: (0, 0, 0), intensity: 1),
    },
)"#;

fn load_text(scene: &str, defines: &[(&str, &str)]) -> Result<Loaded, Diagnostics> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.ron");
    std::fs::write(&path, scene).expect("a file");
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(&path, &defines)
}

fn light(defines: &[(&str, &str)], name: &str) -> PointLight {
    load_text(SCENE, defines).unwrap_or_else(|errors| panic!("{errors}")).description.lights[name]
}

#[test]
fn every_field_arrives() {
    let bulb = PointLight { position: DVec3::new(1.0, 2.0, 3.0), intensity: Vec3::new(4.0, 5.0, 6.0), cone: None };
    assert_eq!(light(&[], "bulb"), bulb);
    let cone = SpotCone { look_at: DVec3::Z, angle: 30.0, blend: 0.5 };
    let lamp = PointLight { position: 3.0 * DVec3::Y, intensity: Vec3::splat(10.0), cone: Some(cone) };
    assert_eq!(light(&[], "lamp"), lamp);
    let cone = light(&[], "plain").cone.expect("a spot");
    assert_eq!((cone.angle, cone.blend), (SpotCone::ANGLE, SpotCone::BLEND));
}

#[test]
fn defines_change_them() {
    assert_eq!(light(&[("lights.bulb.position", "(7, 8, 9)")], "bulb").position, DVec3::new(7.0, 8.0, 9.0));
    assert_eq!(light(&[("lights.lamp.angle", "12")], "lamp").cone.expect("a spot").angle, 12.0);
    let new = ("lights.new", "Point(position: (0, 1, 0), intensity: 2)");
    assert_eq!(light(&[new], "new").intensity, Vec3::splat(2.0));
    let without = load_text(SCENE, &[("lights.bulb", "None")]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(Vec::from_iter(without.description.lights.keys()), ["lamp", "plain"]);
}

#[test]
fn a_near_miss_of_a_name_says_what_was_meant() {
    let errors = load_text(SCENE, &[("lights.bulbb.intensity", "8")]).expect_err("no such light");
    let shown = errors.to_string();
    assert!(
        shown.contains("-D:1:8: error: there is no `lights.bulbb` to change") && shown.contains("did you mean `bulb`?"),
        "{shown}"
    );
    assert_eq!(errors.list.len(), 1, "{shown}");
}

/// A light, the column of what is wrong with it in the second line, and a part of what is said.
const WRONG: [(&str, u32, &str); 13] = [
    ("Point(position: (0, 0, 0))", 15, "the field `intensity` is missing"),
    ("Point(intensity: 1)", 15, "the field `position` is missing"),
    ("Point(position: (0, 0, 0), intensity: -1)", 48, "expected a number from 0 to"),
    ("Point(position: (0, 0, 0), intensity: NaN)", 48, "found `NaN`"),
    ("Point(position: (0, inf, 0), intensity: 1)", 26, "position"),
    ("Point(position: (0, 0, 0), intensity: 1, angle: 3)", 51, "angle"),
    ("Spot(position: (0, 0, 0), intensity: 1)", 14, "the field `look_at` is missing"),
    ("Spot(position: (0, 0, 1), look_at: (0, 0, 1), intensity: 1)", 14, "are the same point"),
    ("Spot(position: (0, 0, 1), look_at: (0, 0, 0), intensity: 1, angle: 0)", 77, "expected a number from 0.01 to 180"),
    (
        "Spot(position: (0, 0, 1), look_at: (0, 0, 0), intensity: 1, angle: 181)",
        77,
        "expected a number from 0.01 to 180",
    ),
    ("Spot(position: (0, 0, 1), look_at: (0, 0, 0), intensity: 1, blend: 1.5)", 77, "expected a number from 0 to 1"),
    ("Sun(position: (0, 0, 1))", 10, "expected Point(position: .., intensity: ..) or Spot("),
    ("(position: (0, 0, 1), intensity: 1)", 10, "expected Point(position: .., intensity: ..) or Spot("),
];

#[test]
fn what_is_wrong_is_told_at_its_place() {
    for (text, column, part) in WRONG {
        let scene = format!("(lights: {{\n    \"a\": {text},\n}})");
        let errors = load_text(&scene, &[]).expect_err(text);
        let told = errors.list.iter().map(|error| (error.line, error.column, error.message.clone()));
        let told: Vec<_> = told.collect();
        let found = told.iter().any(|(line, at, message)| (*line, *at) == (2, column) && message.contains(part));
        assert!(found, "{text}: {told:?}");
    }
}

#[test]
fn the_way_back_gives_the_same_lights() {
    let description = load_text(SCENE, &[]).unwrap_or_else(|errors| panic!("{errors}")).description;
    let mut world = World::new();
    apply(&mut world, &description);
    assert_eq!(describe(&world, "scene").lights, description.lights);
    let tick = world.change_tick();
    world.increment_change_tick();
    apply(&mut world, &description);
    let mut lights = world.query::<Ref<PointLight>>();
    assert!(lights.iter(&world).all(|light| !light.last_changed().is_newer_than(tick, world.read_change_tick())));
    let mut fewer = description.clone();
    fewer.lights.remove("bulb");
    apply(&mut world, &fewer);
    assert_eq!(describe(&world, "scene").lights, fewer.lights);
}

#[test]
fn a_model_alone_is_not_lit_by_day_where_it_has_lights() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("m.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    let lit = Define::given("lights.a", "Point(position: (0, 0, 2), intensity: 5)");
    let environment =
        |defines: &[Define]| load(&path, defines).unwrap_or_else(|errors| panic!("{errors}")).description.environment;
    assert!(environment(&[]).is_some());
    assert!(environment(&[lit]).is_none());
}
