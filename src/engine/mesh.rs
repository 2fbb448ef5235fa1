//! What is known of one mesh, by its name.

use bevy_ecs::prelude::*;
use glam::DVec3;

use crate::components::{Name, UsesMaterial};
use crate::systems::resources::{MeshSlot, SceneGeometry};

/// A mesh as it was last extracted.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshExtent {
    /// Name of its material; none if it has the default one.
    pub material: Option<String>,
    pub triangles: u32,
    /// World space corners, scene units; low above high where it has no triangles.
    pub low: DVec3,
    pub high: DVec3,
}

/// The mesh of a name, if there is one.
pub fn extent(world: &World, name: &str) -> Option<MeshExtent> {
    let named = |entity: Entity| world.get::<Name>(entity).map(Name::as_str);
    let mesh = *world.resource::<SceneGeometry>().meshes.iter().find(|mesh| named(**mesh) == Some(name))?;
    let MeshSlot { count, low, high, .. } = world.get::<MeshSlot>(mesh)?;
    let material = world.get::<UsesMaterial>(mesh).and_then(|uses| named(uses.0)).map(str::to_owned);
    Some(MeshExtent { material, triangles: *count, low: *low, high: *high })
}
