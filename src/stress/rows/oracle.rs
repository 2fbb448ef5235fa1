//! The engine against the f64 path tracer, which shares nothing with it.

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, UVec2};

use crate::components::{Render, Sampler};
use crate::layout::trace::TraceParams;
use crate::oracle::Oracle;
use crate::scene::{self, SceneDescription};
use crate::stats::agreement::{BATCHES, MOST_ERRORS};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{Inside, room, thousand_lights};
use crate::stress::tools::films::estimates;
use crate::stress::tools::paths::{as_measured, block_sums, compare};

pub static ROW: Row = Row {
    name: "oracle",
    holds: "the engine has the mean of a path tracer in f64 that shares no code with it",
    quantity: "standard errors between engine and oracle",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [2_000_000, 3_000_000, 30_000_000],
    measure,
};

const SIDE: u32 = 8;

/// What is rendered by both, and by which sampler.
fn scenes(scale: Scale) -> Vec<(&'static str, SceneDescription, Sampler)> {
    let size = UVec2::splat(SIDE);
    let of = |inside| room(size, inside, DAffine3::IDENTITY);
    let mut scenes = vec![("rough balls", of(Inside::Rough), Sampler::Sobol)];
    if scale != Scale::Test {
        scenes.push(("glass and mirror", of(Inside::Smooth), Sampler::Sobol));
    }
    if scale == Scale::Full {
        scenes.push(("a thousand lights", thousand_lights(size), Sampler::Pcg));
    }
    scenes
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let scenes = scenes(lab.scale());
    let films = (scenes.len() * BATCHES) as u64;
    let spp = size.div_ceil(films * u64::from(SIDE * SIDE)) as u32;
    let mut all = Measured::new(0.0, 0);
    for (k, (name, description, sampler)) in scenes.into_iter().enumerate() {
        let render = Render { spp, sampler, ..description.render };
        let description = SceneDescription { render, ..description };
        let mut world = World::new();
        scene::apply(&mut world, &description);
        let oracle = Oracle::new(&mut world)?;
        let threads = std::thread::available_parallelism().map_or(2, usize::from);
        let params = TraceParams { window_width: SIDE, window_height: SIDE, layers: 1, ..TraceParams::default() };
        let right = |i: usize| {
            lab.tell((k * BATCHES + i) as u64, films);
            let mean = oracle.render(i as u32 * spp..(i as u32 + 1) * spp, 1, threads, &|_, _| ()).mean;
            let at = |p: UVec2| -> DVec3 { mean[(p.y * SIDE + p.x) as usize] };
            Ok(block_sums(&params, |_, p| (at(p), 0)))
        };
        let agreement = compare(estimates(lab, &description, 0)?, right)?;
        all = all.worst(as_measured(agreement, u64::from(spp * SIDE * SIDE) * BATCHES as u64, name));
    }
    Ok(all)
}
