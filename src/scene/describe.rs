//! Entities to a description: the way back of [`apply`](super::apply()).

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryState;

use super::description::{MeshEntry, SceneDescription};
use super::mtl::MtlMaterial;
use crate::components::{
    CameraItem, EnvironmentItem, Film, Geometry, Maps, Material, Name, PointLight, Render, ShaderValues, Texture,
    Transform, UsesMaterial, rendered_camera, rendered_environment,
};

type Surface = (Entity, &'static Name, &'static Material, Option<&'static MtlMaterial>, Option<&'static Maps>);
type Mesh = (&'static Name, &'static Geometry, Option<&'static Transform>, Option<&'static UsesMaterial>);

/// What the world holds now, edits included. Applied to another world, it makes that one equal; entities without a `Name`
/// are left out.
pub fn describe(world: &World, name: &str) -> SceneDescription {
    let key = |name: &Name| name.as_str().to_owned();
    let mut materials = BTreeMap::new();
    let mut names: BTreeMap<Entity, String> = BTreeMap::new();
    let textures: BTreeMap<String, Entity> =
        query::<(Entity, &Name, &Texture)>(world).iter(world).map(|(entity, name, _)| (key(name), entity)).collect();
    for (entity, name, material, numbers, maps) in query::<Surface>(world).iter(world) {
        // Of a material that was edited by itself, what files said is not true any more.
        let numbers = numbers.map(|numbers| numbers.as_rendered(material, maps.unwrap_or(&Maps::default()), &textures));
        materials.insert(key(name), numbers.unwrap_or_else(|| MtlMaterial::from(*material)));
        names.insert(entity, key(name));
    }
    let entry = |(name, geometry, transform, uses): (&Name, &Geometry, Option<&Transform>, Option<&UsesMaterial>)| {
        // A name that no material has stands for none.
        let material = uses.and_then(|uses| names.get(&uses.0)).cloned().unwrap_or_default();
        let transform = transform.copied().unwrap_or_default();
        (key(name), MeshEntry { geometry: geometry.0.clone(), transform, material })
    };
    let meshes = query::<Mesh>(world).iter(world).map(entry).collect();
    let mut cameras = query::<CameraItem>(world);
    let active = rendered_camera(cameras.iter(world)).map(|(_, name, _)| key(name));
    let (film, render) = query::<(&Film, &Render)>(world).iter(world).next().map(|(f, r)| (*f, *r)).unwrap_or_default();
    SceneDescription {
        name: name.to_owned(),
        meshes,
        materials,
        textures: query::<(&Name, &Texture)>(world).iter(world).map(|(name, t)| (key(name), t.clone())).collect(),
        active: active.unwrap_or_default(),
        cameras: cameras.iter(world).map(|(_, name, camera, _)| (key(name), *camera)).collect(),
        lights: query::<(&Name, &PointLight)>(world).iter(world).map(|(name, light)| (key(name), *light)).collect(),
        film,
        render,
        shader: query::<&ShaderValues>(world).iter(world).next().cloned().unwrap_or_default(),
        environment: rendered_environment(query::<EnvironmentItem>(world).iter(world)).cloned(),
    }
}

/// A query of a world that a description was applied to, and so knows all components of scenes.
fn query<D: bevy_ecs::query::QueryData>(world: &World) -> QueryState<D> {
    world.try_query().expect("invariant: apply registers the components of scenes")
}
