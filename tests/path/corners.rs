//! No path leaves a closed room, however its walls lie: rays that leave from where two walls meet.

use glam::{DQuat, DVec3, UVec2, Vec3};
use lucerna::components::Camera;
use lucerna::gpu::Runtime;
use lucerna::layout::trace::TraceParams;
use lucerna::prepare::camera;
use lucerna::scene::generate::SplitMix;
use lucerna::shader::Library;

use crate::rooms::{Room, matte};
use crate::support;
use crate::support::plant::planted;

use super::samples;

/// A closed prism over a convex polygon, turned and moved off the grid, and where its corners are.
fn prism(polygon: &[(f64, f64)], seed: u64) -> (Room, Vec<DVec3>) {
    let mut random = SplitMix(seed);
    let mut turn = || random.range(-3.0, 3.0);
    let rotation = DQuat::from_euler(glam::EulerRot::XYZ, turn(), turn(), turn());
    let offset = DVec3::new(random.range(-0.3, 0.3), random.range(-0.3, 0.3), random.range(-0.3, 0.3));
    let place = |x: f64, y: f64, z: f64| rotation * DVec3::new(x, y, z) + offset;
    let ring = |y: f64| polygon.iter().map(|&(x, z)| place(x, y, z)).collect::<Vec<_>>();
    let (low, high) = (ring(-0.7), ring(0.9));
    let mut room = Room { environment: Vec3::splat(1000.0), ..Room::default() };
    let wall = room.material(matte(Vec3::splat(0.9), Vec3::ZERO));
    let mut face = |corners: &[DVec3]| {
        for pair in corners[1..].windows(2) {
            room.triangle([corners[0], pair[0], pair[1]].map(DVec3::as_vec3), wall);
        }
    };
    face(&low);
    face(&high);
    for i in 0..polygon.len() {
        let j = (i + 1) % polygon.len();
        face(&[low[i], low[j], high[j], high[i]]);
    }
    (room, low.into_iter().chain(high).collect())
}

/// Boxes, a triangle's prism, and wedges of 60, 20 and 10 degrees.
fn polygons() -> Vec<Vec<(f64, f64)>> {
    let wedge = |degrees: f64| {
        let half = f64::to_radians(degrees / 2.0).tan();
        vec![(-0.5, 0.0), (1.0, -1.5 * half), (1.0, 1.5 * half)]
    };
    vec![
        vec![(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
        vec![(-0.6, -1.3), (0.6, -1.3), (0.6, 1.3), (-0.6, 1.3)],
        vec![(-1.0, -0.4), (0.9, -0.7), (0.3, 0.8)],
        wedge(60.0),
        wedge(20.0),
        wedge(10.0),
    ]
}

/// Paths that end before their last segment: those that left the room.
fn escapes(rig: &mut Runtime, params: &TraceParams) -> usize {
    samples(rig, params).iter().filter(|sample| sample.info != params.max_depth).count()
}

/// Looks at points of every edge so closely that all rays end within their rounding of it.
fn escapes_at_edges(library: Library) -> usize {
    let mut rig = Runtime::new(support::gpu(), library);
    let mut escaped = 0;
    for (seed, polygon) in polygons().iter().enumerate() {
        let (room, corners) = prism(polygon, seed as u64);
        room.load(&mut rig);
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let n = polygon.len();
        let edges = (0..n).flat_map(|i| [(i, (i + 1) % n), (n + i, n + (i + 1) % n), (i, n + i)]);
        for (a, b) in edges {
            let look_at = corners[a].lerp(corners[b], 0.37);
            let view = Camera {
                position: middle,
                look_at,
                up: (corners[b] - corners[a]).normalize(),
                fov_y: 1e-5,
                ..Camera::default()
            };
            let mut params = TraceParams { layers: 4, max_depth: 5, ..room.params(UVec2::splat(16)) };
            camera::aim(&mut params, &view, UVec2::splat(16), DVec3::ZERO);
            escaped += escapes(&mut rig, &params);
        }
    }
    escaped
}

#[test]
fn no_path_leaves_a_closed_room_by_its_edges() {
    assert_eq!(escapes_at_edges(Library::shipped()), 0);
    let (right, wrong) = ("let margin = INSET * largest_of(error);", "let margin = 0.0 * largest_of(error);");
    let escaped = escapes_at_edges(planted("lib/intersect", right, wrong));
    assert!(escaped > 100, "points beyond the next wall let {escaped} paths out");
}

/// 10^9 segments in all.
#[test]
fn no_path_leaves_a_closed_room() {
    if !support::stress() {
        return;
    }
    let mut segments = 0u64;
    for seed in 0..20 {
        let polygons = polygons();
        let (room, corners) = prism(&polygons[seed % polygons.len()], 100 + seed as u64);
        let middle = (corners.iter().sum::<DVec3>() / corners.len() as f64).as_vec3();
        let mut rig = support::rig();
        room.load(&mut rig);
        for round in 0..100 {
            let params = TraceParams {
                position: middle,
                layers: 32,
                first_sample: 32 * round,
                max_depth: 64,
                ..room.params(UVec2::splat(128))
            };
            let left = samples(&mut rig, &params).iter().filter(|sample| sample.info != 64).count();
            assert_eq!(left, 0, "room {seed}, round {round}");
            segments += 64 * 32 * 128 * 128;
        }
    }
    assert!(segments > 1_000_000_000);
    eprintln!("{segments} segments, and none left its room");
}
