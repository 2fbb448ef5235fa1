//! Rays that leave from where two walls meet.

use glam::{DVec3, UVec2};

use crate::components::Camera;
use crate::layout::trace::TraceParams;
use crate::prepare::camera;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::prism::{polygons, prism};
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "room-edges",
    holds: "a path that arrives within rounding of where two walls meet, down to 10 degrees, goes on inside",
    quantity: "paths that leave",
    most: 0.0,
    unit: "segments",
    sizes: [300_000, 2_000_000, 100_000_000],
    measure,
};

const SIDE: u32 = 16;
const DEPTH: u32 = 5;

/// Edges of all rooms: three for each of a polygon's corners.
const EDGES: u64 = 60;

/// Looks at points of every edge so closely that all rays end within their rounding of it.
fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let layers = size.div_ceil(EDGES * u64::from(SIDE * SIDE * DEPTH)).min(4096) as u32;
    let mut rig = lab.rig();
    let mut all = Measured::new(0.0, 0);
    for (seed, polygon) in polygons().iter().enumerate() {
        let (room, corners) = prism(polygon, seed as u64);
        room.load(&mut rig)?;
        let position = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let n = polygon.len();
        let edges = (0..n).flat_map(|i| [(i, (i + 1) % n), (n + i, n + (i + 1) % n), (i, n + i)]);
        for (a, b) in edges {
            let look_at = corners[a].lerp(corners[b], 0.37);
            let up = (corners[b] - corners[a]).normalize();
            let view = Camera { position, look_at, up, fov_y: 1e-5, ..Camera::default() };
            let size = UVec2::splat(SIDE);
            let mut params = TraceParams { layers, max_depth: DEPTH, ..room.params(size) };
            camera::aim(&mut params, &view, size, DVec3::ZERO);
            let got = samples(&mut rig, &params)?;
            let left = got.iter().filter(|sample| sample.info != DEPTH).count();
            let segments = got.iter().map(|sample| u64::from(sample.info)).sum();
            all = all.plus(Measured::new(left as f64, segments).noted(format!("room {seed}, edge {a} to {b}")));
        }
        lab.tell(seed as u64 + 1, polygons().len() as u64);
    }
    Ok(all)
}
