//! What is kept of textures and texture coordinates where something else changes: it is what a fresh engine has.

use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2};
use lucerna::Engine;
use lucerna::components::{Name, Reading, Texels, Texture, TextureImage, Transform, UsesMaterial};
use lucerna::gpu::{GpuTable, TableRow};
use lucerna::layout::texture::{CornerUvs, Tangents, TextureRecord};
use lucerna::scene::{MapUse, SceneDescription, describe};
use lucerna::shader::Library;
use lucerna::systems::resources::Texel;

use super::garden::Garden;
use crate::support;

const SIZE: UVec2 = UVec2::new(8, 6);

fn open(description: &SceneDescription) -> Engine {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), description).unwrap();
    engine.step(Duration::from_millis(1)).unwrap();
    engine
}

/// Makes an edit; texture coordinates and tangents are then what a fresh engine has, which is returned.
fn edit(engine: &mut Engine, what: &str, edit: impl FnOnce(&mut World)) -> Engine {
    engine.edit(edit);
    engine.step(Duration::from_millis(1)).unwrap();
    let fresh = open(&engine.edit(|world| describe(world, "s")));
    assert!(bytes::<CornerUvs>(engine) == bytes::<CornerUvs>(&fresh), "{what}: other texture coordinates");
    assert!(bytes::<Tangents>(engine) == bytes::<Tangents>(&fresh), "{what}: other tangents");
    fresh
}

/// A table's contents.
fn bytes<T: TableRow>(engine: &Engine) -> Vec<u8> {
    engine.read(|world| bytemuck::cast_slice(world.resource::<GpuTable<T>>().rows()).to_vec())
}

/// The entity of a mesh or a material.
fn named<C: Component>(world: &mut World, name: &str) -> Entity {
    let mut query = world.query_filtered::<(Entity, &Name), With<C>>();
    let all: Vec<(Entity, String)> = query.iter(world).map(|(entity, name)| (entity, name.to_string())).collect();
    all.iter().find(|(_, own)| own == name).unwrap_or_else(|| panic!("no `{name}` in {all:?}")).0
}

/// The meshes, by the names of their materials: each material of the garden is that of one.
fn mesh_of(world: &mut World, material: &str) -> Entity {
    let material = named::<lucerna::components::Material>(world, material);
    let mut query = world.query::<(Entity, &UsesMaterial)>();
    query.iter(world).find(|(_, uses)| uses.0 == material).unwrap().0
}

#[test]
fn texture_coordinates_follow_the_meshes_that_change() {
    let mut engine = open(&Garden::full(SIZE).description);
    let shift = |world: &mut World, material: &str, by: DVec3| {
        let mesh = mesh_of(world, material);
        let mut moved = world.get::<Transform>(mesh).copied().unwrap_or_default();
        moved.0.translation += by;
        moved.0.matrix3.x_axis *= 1.25;
        world.entity_mut(mesh).insert(moved);
    };
    edit(&mut engine, "a mesh with relief moves", |world| shift(world, "a:wall", DVec3::new(0.1, 0.0, 0.2)));
    edit(&mut engine, "another moves", |world| shift(world, "a:leaf", DVec3::new(0.0, 0.3, 0.0)));
    edit(&mut engine, "a mesh loses its relief", |world| {
        let (mesh, floor) = (mesh_of(world, "a:wall"), named::<lucerna::components::Material>(world, "a:floor"));
        world.entity_mut(mesh).insert(UsesMaterial(floor));
    });
    edit(&mut engine, "a mesh loses its material", |world| {
        let mesh = mesh_of(world, "a:lamp");
        world.entity_mut(mesh).remove::<UsesMaterial>();
    });
    edit(&mut engine, "a mesh goes", |world| {
        let mesh = mesh_of(world, "a:leaf");
        world.despawn(mesh);
    });
}

/// A picture without a pattern that a shift would hide.
fn noise(side: u32) -> Texture {
    let texel = |at: u32| (at.wrapping_mul(0x9e37_79b9) ^ at >> 3).to_le_bytes();
    let image = TextureImage { size: UVec2::splat(side), texels: Texels::Rgba8((0..side * side).map(texel).collect()) };
    Texture::new(Arc::new(image), Reading::Colour)
}

#[test]
fn textures_that_make_room_for_a_large_one_keep_their_words() {
    // 5.6 and 22.4 million words: twice the small and the large one do not fit into 128 MiB, and one of each does.
    let room = support::gpu().limits.max_storage_buffer_binding_size / 4;
    let (small, large) = (noise(2048), noise(4096));
    let words = |texture: &Texture| lucerna::prepare::texture::words(texture, 0);
    if !(words(&small) + words(&large)..2 * words(&small) + words(&large)).contains(&room) {
        return;
    }
    let mut garden = Garden::plain(SIZE);
    for (file, material, texture) in
        [("a", "a:floor", small.clone()), ("b", "a:wall", small.clone()), ("c", "a:leaf", noise(1))]
    {
        let map = garden.add(file, texture, MapUse::Colour);
        garden.description.materials.get_mut(material).unwrap().maps.kd = Some(map);
    }
    let mut engine = open(&garden.description);
    let fresh = edit(&mut engine, "the second moves to where the first was", |world| {
        let mut textures = world.query::<(&Name, &mut Texture)>();
        for (name, mut texture) in textures.iter_mut(world) {
            match name.as_str().chars().next() {
                Some('a') => *texture = noise(1),
                Some('c') => *texture = large.clone(),
                _ => {}
            }
        }
    });
    assert!(bytes::<TextureRecord>(&engine) == bytes::<TextureRecord>(&fresh), "other records");
    assert!(bytes::<Texel>(&engine) == bytes::<Texel>(&fresh), "other texels");
    let uses = engine.textures();
    assert!(uses.iter().all(|used| used.for_room == 0), "{uses:?}");
}
