//! Descriptions become entities, and changes of them change what differs.

use bevy_ecs::prelude::*;
use lucerna::components::{
    Active, Camera, Environment, Film, Geometry, Material, Name, Render, Tone, Transform, UsesMaterial,
};
use lucerna::scene::{apply, apply_changes};

use super::{SCENE, description};

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

/// A file that changes one setting leaves the others what the window made of them.
#[test]
fn a_setting_that_is_the_same_in_both_files_stays_as_it_was_edited() {
    let mut world = World::new();
    let earlier = description(SCENE);
    apply(&mut world, &earlier);
    let mut film = world.query::<(&mut Film, &mut Render)>();
    let (mut held, mut render) = film.single_mut(&mut world).unwrap();
    (held.size, held.exposure, render.seed) = (glam::UVec2::new(300, 200), 2.0, 5);
    let mut later = earlier.clone();
    (later.film.tone, later.render.seed) = (Tone::Agx, 6);
    apply_changes(&mut world, Some(&earlier), &later);
    let (film, render) = film.single(&world).unwrap();
    assert_eq!((film.size, film.exposure, film.tone), (glam::UVec2::new(300, 200), 2.0, Tone::Agx));
    assert_eq!((film.crop, render.seed, render.max_depth), (earlier.film.crop, 6, earlier.render.max_depth));
}
