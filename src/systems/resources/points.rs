//! Which point light is in which row of the table of lights.

use bevy_ecs::prelude::*;

use super::SceneGeometry;
use crate::components::{Name, PointLight};
use crate::prepare::point::point_light;

/// The names of the point lights that are in the table, in the order of their rows: of those that shine, the order of names.
pub fn point_names(world: &World) -> Vec<String> {
    let origin = world.resource::<SceneGeometry>().origin;
    let Some(mut found) = world.try_query::<(&Name, &PointLight)>() else { return Vec::new() };
    let shines = |light: &PointLight| {
        let power = point_light(light, origin).power;
        power > 0.0 && power.is_finite()
    };
    let lit = found.iter(world).filter(|(_, light)| shines(light));
    let mut names: Vec<String> = lit.map(|(name, _)| name.to_string()).collect();
    names.sort();
    names
}
