//! Paths of a pixel as the kernel traces them, without what the twin says of each: for who wants to see many of them; and what hides points.
//!
//! Plain functions, no system: they ask the device, and change nothing in the world.

use std::ops::Range;

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec3};

use super::replay::one_sample;
use crate::cpu::turn::{Turn, turns_of};
use crate::gpu::GpuTable;
use crate::layout::ray::{NO_HIT, Ray};
use crate::layout::replay::{MOST_TURNS, PathTurn, Replayed};
use crate::layout::trace::SAMPLE_BAD;
use crate::layout::tree::Triangle;
use crate::passes::{Recording, extend, replay};
use crate::systems::EngineError;
use crate::systems::resources::{Device, SceneGeometry, Shot, Tree};

/// What hides a point is nearer than it by more than this part of its distance: a surface does not hide what lies on it.
const NEARER: f64 = 1e-4;

/// The path of a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedPath {
    /// Of the film.
    pub sample: u32,
    /// Its rays, in order, relative to `origin`.
    pub turns: Vec<Turn>,
    /// What the pixel gets of it by itself, linear Rec.709; none of a bad sample.
    pub radiance: Option<Vec3>,
    /// World space.
    pub origin: DVec3,
}

/// Samples of a pixel of the whole film; nothing where there is no such pixel, or no tree yet.
pub fn trace_paths(world: &mut World, pixel: UVec2, samples: Range<u32>) -> Result<Vec<TracedPath>, EngineError> {
    let (params, origin) = (world.resource::<Shot>().params, world.resource::<SceneGeometry>().origin);
    let film = UVec2::new(params.film_width, params.film_height);
    if pixel.cmpge(film).any() || !world.resource::<Tree>().built {
        return Ok(Vec::new());
    }
    let device = &mut world.resource_mut::<Device>().0;
    for (name, bytes) in replay::buffers() {
        device.reserve(name, bytes)?;
    }
    let mut paths = Vec::new();
    for sample in samples {
        let mut recording = Recording::default();
        replay::record(&mut recording, &one_sample(&params, pixel, sample));
        device.play(&recording)?;
        let Replayed { rgb, info, turns, .. } = device.read_one("replayed", 0)?;
        let kept: Vec<PathTurn> = device.read_some("turns", turns.min(MOST_TURNS) as usize)?;
        let radiance = (info & SAMPLE_BAD == 0).then_some(rgb);
        paths.push(TracedPath { sample, turns: turns_of(&kept), radiance, origin });
    }
    device.check_loops()?;
    Ok(paths)
}

/// Of each point whether something hides it from the camera, world space; none of them where there is no tree yet.
pub fn hidden(world: &mut World, points: &[DVec3]) -> Result<Vec<bool>, EngineError> {
    let (params, origin) = (world.resource::<Shot>().params, world.resource::<SceneGeometry>().origin);
    let triangles = world.resource::<GpuTable<Triangle>>().len() as u32;
    if points.is_empty() || triangles == 0 || !world.resource::<Tree>().built {
        return Ok(vec![false; points.len()]);
    }
    let camera = params.position.as_dvec3();
    let rays: Vec<Ray> = points
        .iter()
        .map(|point| {
            let to = *point - origin - camera;
            let direction = to.normalize_or(params.forward.as_dvec3()).as_vec3();
            Ray { origin: params.position, t_min: 0.0, direction, t_max: (to.length() * (1.0 - NEARER)) as f32 }
        })
        .collect();
    let count = rays.len() as u32;
    let device = &mut world.resource_mut::<Device>().0;
    for (name, bytes) in extend::buffers(count) {
        device.reserve(name, bytes)?;
    }
    device.upload("rays", &rays)?;
    let mut recording = Recording::default();
    extend::record(&mut recording, count, triangles);
    device.play(&recording)?;
    let hits: Vec<crate::layout::ray::Hit> = device.read_some("hits", rays.len())?;
    Ok(hits.iter().map(|hit| hit.triangle != NO_HIT).collect())
}
