//! The scene's cameras, and which of them is looked through.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use crate::components::{Active, Camera, CameraItem, Name, rendered_camera};

/// All cameras by name.
pub fn all(world: &World) -> BTreeMap<String, Camera> {
    let Some(mut cameras) = world.try_query::<(&Name, &Camera)>() else { return BTreeMap::new() };
    cameras.iter(world).map(|(name, camera)| (name.as_str().to_owned(), *camera)).collect()
}

/// Moves the camera that is rendered. Says whether it was elsewhere.
pub fn set_view(world: &mut World, view: Camera) -> bool {
    let mut cameras = world.query::<CameraItem>();
    let rendered = rendered_camera(cameras.iter(world)).filter(|(.., camera)| **camera != view);
    let Some(entity) = rendered.map(|(entity, ..)| entity) else { return false };
    world.entity_mut(entity).insert(view);
    true
}

/// Looks through the camera of a name from now on, and puts it where it is to be.
pub fn choose(world: &mut World, name: &str, view: Camera) {
    let mut cameras = world.query_filtered::<(Entity, &Name, Has<Active>), With<Camera>>();
    let found: Vec<(Entity, bool, bool)> =
        cameras.iter(world).map(|(entity, other, active)| (entity, other.as_str() == name, active)).collect();
    if !found.iter().any(|(_, chosen, _)| *chosen) {
        return;
    }
    for (entity, chosen, active) in found {
        match (chosen, active) {
            (true, false) => {
                world.entity_mut(entity).insert(Active);
            }
            (false, true) => {
                world.entity_mut(entity).remove::<Active>();
            }
            _ => {}
        }
    }
    set_view(world, view);
}
