//! When what was found of one scene holds for another, and when its pictures do. Pure.

use std::sync::Arc;

use crate::components::Film;
use crate::scene::SceneDescription;

/// Whether two scenes are the same but for camera, film and number of samples. What they share is told apart by where it is.
pub fn is_alike(one: &SceneDescription, other: &SceneDescription) -> bool {
    let alike = one.meshes.len() == other.meshes.len()
        && one.meshes.iter().zip(&other.meshes).all(|((name, mesh), (other_name, other))| {
            name == other_name
                && Arc::ptr_eq(&mesh.geometry, &other.geometry)
                && (&mesh.transform, &mesh.material) == (&other.transform, &other.material)
        });
    let rest = |scene: &SceneDescription| {
        let mut rest = SceneDescription { meshes: Default::default(), cameras: Default::default(), ..scene.clone() };
        (rest.film, rest.render.spp) = (Film::default(), 0);
        rest.active.clear();
        rest
    };
    alike && rest(one) == rest(other)
}

/// Whether they are the same, seen from the same place and shown in the same way: pictures of one are pictures of the other.
pub fn looks_alike(one: &SceneDescription, other: &SceneDescription) -> bool {
    let view = |scene: &SceneDescription| (scene.cameras.get(&scene.active).copied(), scene.film);
    is_alike(one, other) && view(one) == view(other)
}
