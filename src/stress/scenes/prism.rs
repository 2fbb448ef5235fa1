//! Closed rooms whose walls lie along no axis.

use glam::{DQuat, DVec3, Vec3};

use super::room::{Room, matte};
use crate::scene::generate::SplitMix;

/// A closed prism over a convex polygon, turned and moved off the grid, and where its corners are.
pub fn prism(polygon: &[(f64, f64)], seed: u64) -> (Room, Vec<DVec3>) {
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
pub fn polygons() -> Vec<Vec<(f64, f64)>> {
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
