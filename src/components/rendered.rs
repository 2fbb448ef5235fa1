//! Which of several cameras, and which environment, is rendered: the one place that says so.

use bevy_ecs::prelude::*;

use super::{Active, Camera, Environment, Name};

/// What [`rendered_camera`] chooses from.
pub type CameraItem = (Entity, &'static Name, &'static Camera, Has<Active>);

/// What [`rendered_environment`] chooses from.
pub type EnvironmentItem = (Entity, &'static Name, &'static Environment);

/// The camera that is rendered: the first by name of those marked [`Active`]; without a mark, of all.
pub fn rendered_camera<'a>(
    cameras: impl IntoIterator<Item = (Entity, &'a Name, &'a Camera, bool)>,
) -> Option<(Entity, &'a Name, &'a Camera)> {
    let first = cameras.into_iter().min_by_key(|(entity, name, _, active)| (!active, name.as_str(), *entity));
    first.map(|(entity, name, camera, _)| (entity, name, camera))
}

/// The environment that is rendered: the first by name.
pub fn rendered_environment<'a>(
    environments: impl IntoIterator<Item = (Entity, &'a Name, &'a Environment)>,
) -> Option<&'a Environment> {
    let first = environments.into_iter().min_by_key(|(entity, name, _)| (name.as_str(), *entity));
    first.map(|(.., environment)| environment)
}
