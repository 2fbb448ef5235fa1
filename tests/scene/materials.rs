//! What scene files change of materials.

use bevy_ecs::prelude::*;
use lucerna::components::{Lobe, Material, Passage};
use lucerna::scene::{MtlMaterial, apply, describe};

use super::{SCENE, description, load_text};

#[test]
fn materials_that_are_not_rendered_as_asked_are_warned_of() {
    let text = "(models: [(path: \"square.obj\")], materials: { \"red\": (d: 0.5, tf: (1, 1, 0.5), illum: 10) }, environment: Constant(1))";
    let loaded = load_text(text, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let places: Vec<u32> = loaded.warnings.iter().map(|warning| warning.column).collect();
    assert_eq!(places, [87], "{:?}", loaded.warnings);
    assert!(loaded.warnings[0].message.contains("shadow catcher"));
}

#[test]
fn every_number_of_a_material_can_be_changed() {
    let text = "(models: [(path: \"square.obj\")], materials: { \"red\": (pr: 0.25, pm: 0.5, d: 0.75, ni: 1.5, tf: 0.5, \
                illum: 7) }, environment: Constant(1))";
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
