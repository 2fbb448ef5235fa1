//! What one pixel of the film holds, and what is seen through its middle.
//!
//! Plain functions, no system: they ask the device, and change nothing in the world.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::film::progress;
use crate::components::{Name, UsesMaterial};
use crate::cpu::film::joined_mean;
use crate::cpu::texture::{level_of, nearest_texel};
use crate::cpu::textured::Cone;
use crate::cpu::view::{middle_ray, through_middle};
use crate::gpu::GpuTable;
use crate::layout::film::FilmPixel;
use crate::layout::ray::{Hit, NO_HIT};
use crate::layout::trace::TraceParams;
use crate::layout::tree::Triangle;
use crate::passes::{Recording, extend};
use crate::systems::EngineError;
use crate::systems::resources::{Device, MeshSlot, SceneGeometry, Shot, Textures, texture_set};

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
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Name of the mesh.
    pub mesh: String,
    /// Name of its material; none if it has the default one.
    pub material: Option<String>,
    /// Distance from the camera along the viewing axis, scene units: what a lens is focused to.
    pub distance: f64,
    /// Where it is in pictures, v up; none where the material looks nothing up.
    pub uv: Option<[f64; 2]>,
    pub texels: Vec<LookedUp>,
}

/// A texel that a surface is looked up at.
#[derive(Clone, Debug, PartialEq)]
pub struct LookedUp {
    /// What it multiplies: `diffuse`, `relief` and so on.
    pub of: &'static str,
    /// Name of the texture.
    pub texture: String,
    /// Column and row in the picture as it is on the device, from the top left.
    pub texel: UVec2,
    /// Its red, green, blue and alpha, linear; of heights, by how much they grow along u and v.
    pub value: [f64; 4],
    /// The level that the camera's footprint asks for; 0 is the picture.
    pub level: f64,
}

/// Looks at a pixel of the picture; none if there is no such pixel, or nothing was traced yet.
pub fn inspect(world: &mut World, pixel: UVec2) -> Result<Option<Inspected>, EngineError> {
    let shot = world.resource::<Shot>();
    let (size, joined, shot, exponent) = (shot.size(), shot.joined(), shot.params, shot.exponent);
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
    let (radiance, samples) = joined_mean(&held, exponent, joined);
    let bad = held.halves.iter().map(|half| half.bad).sum();
    let distance = f64::from(hit.t) / through_middle(&shot, pixel).as_dvec3().length();
    let surface = surface_of(world, hit.triangle, distance).map(|surface| look_up(world, surface, &shot, &hit));
    Ok(Some(Inspected { pixel, radiance, samples, bad, surface }))
}

/// The mesh that has a triangle, and its material; so far away.
fn surface_of(world: &World, triangle: u32, distance: f64) -> Option<Seen> {
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
    Some(Seen { mesh: name(mesh)?, material, distance, uv: None, texels: Vec::new() })
}

/// Adds what the surface's textures have where a ray through the middle of a pixel hits it.
fn look_up(world: &World, surface: Seen, shot: &TraceParams, hit: &Hit) -> Seen {
    let textures = texture_set(world);
    let Some(triangle) = world.resource::<GpuTable<Triangle>>().rows().get(hit.triangle as usize) else {
        return surface;
    };
    let maps = textures.maps(triangle.material);
    if !maps.is_textured() {
        return surface;
    }
    let cone = Cone { width: 0.0, spread: shot.cone_spread.into() };
    let weights = [hit.b1.into(), hit.b2.into()];
    let point = textures.point_with(hit.triangle, weights, cone.width_at(hit.t.into()), [0.0; 2]);
    let uses = &world.resource::<Textures>().uses;
    let named = [
        ("diffuse", maps.diffuse),
        ("specular", maps.specular),
        ("lobe", maps.lobe),
        ("metallic", maps.metallic),
        ("emission", maps.emission),
        ("opacity", maps.opacity),
        ("relief", maps.relief),
    ];
    let texel = |(of, map): (&'static str, u32)| {
        let t = textures.record(map);
        let place = nearest_texel(t, point);
        let texture = uses.get(map as usize - 1).map_or(String::new(), |used| used.name.clone());
        LookedUp { of, texture, texel: place.at, value: textures.texel(t, place).to_array(), level: level_of(t, point) }
    };
    let texels = named.into_iter().filter(|(_, map)| *map != 0).map(texel).collect();
    Seen { uv: Some(point.uv.to_array()), texels, ..surface }
}
