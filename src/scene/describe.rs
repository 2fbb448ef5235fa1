//! Entities to a description: the way back of [`apply`](super::apply()).

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::load::{MeshEntry, SceneDescription};
use crate::components::{Active, Camera, Environment, Film, Geometry, Material, Name, Render, Transform, UsesMaterial};

type Mesh<'a> = (&'a Name, &'a Geometry, Option<&'a Transform>, Option<&'a UsesMaterial>);

/// What the world holds now, edits included. Applied to another world, it makes that one equal; entities without a `Name`
/// are left out.
pub fn describe(world: &mut World, name: &str) -> SceneDescription {
    let key = |name: &Name| name.as_str().to_owned();
    let materials: Vec<(Entity, String, Material)> =
        world.query::<(Entity, &Name, &Material)>().iter(world).map(|(e, n, m)| (e, key(n), m.clone())).collect();
    let names: BTreeMap<Entity, String> = materials.iter().map(|(e, n, _)| (*e, n.clone())).collect();
    let entry = |(name, geometry, transform, uses): (&Name, &Geometry, Option<&Transform>, Option<&UsesMaterial>)| {
        // A name that no material has stands for none.
        let material = uses.and_then(|uses| names.get(&uses.0)).cloned().unwrap_or_default();
        let transform = transform.copied().unwrap_or_default();
        (key(name), MeshEntry { geometry: geometry.0.clone(), transform, material })
    };
    let meshes = world.query::<Mesh>().iter(world).map(entry).collect();
    let mut cameras: Vec<(bool, String, Camera)> =
        world.query::<(Has<Active>, &Name, &Camera)>().iter(world).map(|(a, n, c)| (!a, key(n), *c)).collect();
    // The one that is rendered: by name, of those that are marked.
    cameras.sort_by(|a, b| (a.0, &a.1).cmp(&(b.0, &b.1)));
    let (film, render) =
        world.query::<(&Film, &Render)>().iter(world).next().map(|(f, r)| (*f, *r)).unwrap_or_default();
    SceneDescription {
        name: name.to_owned(),
        meshes,
        materials: materials.into_iter().map(|(_, name, material)| (name, material)).collect(),
        active: cameras.first().map(|camera| camera.1.clone()).unwrap_or_default(),
        cameras: cameras.into_iter().map(|(_, name, camera)| (name, camera)).collect(),
        film,
        render,
        environment: world.query::<&Environment>().iter(world).next().cloned(),
    }
}
