//! Rooms without a gap under a bright sky.

use glam::{DVec3, UVec2};

use crate::layout::trace::TraceParams;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::prism::{polygons, prism};
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "closed-rooms",
    holds: "no path leaves any of twenty closed rooms, rotated and off the grid, under a sky of 1000",
    quantity: "paths that leave",
    most: 0.0,
    unit: "segments",
    sizes: [5_000_000, 20_000_000, 1_300_000_000],
    measure,
};

const ROOMS: u64 = 20;

/// Pixels a side, and segments of a path.
const SIDE: u32 = 64;
const DEPTH: u32 = 64;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let a_layer = u64::from(SIDE * SIDE * DEPTH);
    let layers = size.div_ceil(ROOMS * a_layer) as u32;
    let mut all = Measured::new(0.0, 0);
    let polygons = polygons();
    let mut rig = lab.rig();
    for seed in 0..ROOMS {
        let (room, corners) = prism(&polygons[seed as usize % polygons.len()], 100 + seed);
        room.load(&mut rig)?;
        if seed % 2 == 1 {
            // Every other room by the walk of its tree.
            let features = room.features();
            rig.set_features(&features.into_iter().filter(|f| *f != "few_triangles").collect::<Vec<_>>());
        }
        let position = (corners.iter().sum::<DVec3>() / corners.len() as f64).as_vec3();
        let mut first_sample = 0;
        while first_sample < layers {
            let layers = (layers - first_sample).min(if lab.is_software() { 1 } else { 64 });
            let params = room.params(UVec2::splat(SIDE));
            let params = TraceParams { position, layers, first_sample, max_depth: DEPTH, ..params };
            let got = samples(&mut rig, &params)?;
            let left = got.iter().filter(|sample| sample.info != DEPTH).count();
            let segments = got.iter().map(|sample| u64::from(sample.info)).sum();
            all = all.plus(Measured::new(left as f64, segments).noted(format!("room {seed}")));
            first_sample += layers;
        }
        lab.tell(seed + 1, ROOMS);
    }
    Ok(all)
}
