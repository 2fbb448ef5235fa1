//! The scene's cameras, and which of them is looked through.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use crate::components::{Active, Camera, Name};

/// All cameras by name.
pub fn all(world: &mut World) -> BTreeMap<String, Camera> {
    world.query::<(&Name, &Camera)>().iter(world).map(|(name, camera)| (name.as_str().to_owned(), *camera)).collect()
}

/// The camera that is rendered, chosen as the engine does.
fn rendered(world: &mut World) -> Option<(Entity, String, Camera)> {
    let mut cameras = world.query::<(Entity, &Name, &Camera, Has<Active>)>();
    let found = cameras.iter(world).min_by_key(|(entity, name, _, active)| (!active, name.as_str(), *entity));
    found.map(|(entity, name, camera, _)| (entity, name.as_str().to_owned(), *camera))
}

/// Name and view of the camera that is rendered.
pub fn view(world: &mut World) -> Option<(String, Camera)> {
    rendered(world).map(|(_, name, camera)| (name, camera))
}

/// Moves the camera that is rendered. Says whether it was elsewhere.
pub fn set_view(world: &mut World, view: Camera) -> bool {
    let Some((entity, ..)) = rendered(world).filter(|(.., camera)| *camera != view) else { return false };
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
