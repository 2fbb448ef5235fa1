//! What one pixel of the film holds, and what is seen through its middle.
//!
//! Plain functions, no system: they ask the device, and change nothing in the world.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::film::progress;
use crate::components::{Name, UsesMaterial};
use crate::cpu::film::pixel_mean;
use crate::cpu::view::middle_ray;
use crate::gpu::GpuTable;
use crate::layout::film::FilmPixel;
use crate::layout::ray::{Hit, NO_HIT};
use crate::layout::tree::Triangle;
use crate::passes::{Recording, extend};
use crate::systems::EngineError;
use crate::systems::resources::{Device, MeshSlot, SceneGeometry, Shot};

/// A pixel, looked at closely.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspected {
    /// From the top left of the picture.
    pub pixel: UVec2,
    /// Mean radiance, linear Rec.709.
    pub radiance: [f64; 3],
    /// Samples behind it.
    pub samples: u32,
    /// Samples that were no numbers, or too large, and are not in it.
    pub bad: u32,
    /// What the middle of the pixel sees; none where that is the environment.
    pub surface: Option<Seen>,
}

/// Something that a ray hit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Name of the mesh.
    pub mesh: String,
    /// Name of its material; none if it has the default one.
    pub material: Option<String>,
}

/// Looks at a pixel of the picture; none if there is no such pixel, or nothing was traced yet.
pub fn inspect(world: &mut World, pixel: UVec2) -> Result<Option<Inspected>, EngineError> {
    let shot = world.resource::<Shot>();
    let (size, shot, exponent) = (shot.size(), shot.params, shot.exponent);
    let triangles = world.resource::<GpuTable<Triangle>>().len() as u32;
    if !progress(world).begun || pixel.cmpge(size).any() {
        return Ok(None);
    }
    let device = &mut world.resource_mut::<Device>().0;
    let index = u64::from(pixel.y) * u64::from(size.x) + u64::from(pixel.x);
    let held: FilmPixel = device.read_one("film", index)?;
    for (name, bytes) in extend::buffers(1) {
        device.reserve(name, bytes)?;
    }
    device.write("rays", 0, &[middle_ray(&shot, pixel)])?;
    let mut recording = Recording::default();
    extend::record(&mut recording, 1, triangles);
    device.play(&recording)?;
    let hit: Hit = device.read_one("hits", 0)?;
    let (radiance, samples) = pixel_mean(&held, exponent);
    let bad = held.halves.iter().map(|half| half.bad).sum();
    Ok(Some(Inspected { pixel, radiance, samples, bad, surface: surface_of(world, hit.triangle) }))
}

/// The mesh that has a triangle, and its material.
fn surface_of(world: &World, triangle: u32) -> Option<Seen> {
    if triangle == NO_HIT {
        return None;
    }
    let has = |entity: &&Entity| {
        let slot = world.get::<MeshSlot>(**entity);
        slot.is_some_and(|slot| (slot.first..slot.first + slot.count).contains(&triangle))
    };
    let mesh = *world.resource::<SceneGeometry>().meshes.iter().find(has)?;
    let name = |entity: Entity| world.get::<Name>(entity).map(|name| name.as_str().to_owned());
    let material = world.get::<UsesMaterial>(mesh).and_then(|uses| name(uses.0));
    Some(Seen { mesh: name(mesh)?, material })
}
