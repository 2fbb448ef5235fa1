//! Closed boxes.

use glam::{UVec2, Vec3};

use super::room::{Room, matte};
use crate::layout::trace::TraceParams;

/// A closed box of one material: the inside of every ray.
pub fn furnace(albedo: f32, emission: f32) -> Room {
    let mut room = Room::default();
    let wall = room.material(matte(Vec3::splat(albedo), Vec3::splat(emission)));
    room.walls([Some(wall); 6]);
    room
}

/// A camera within it.
pub fn inside(room: &Room, size: UVec2, max_depth: u32) -> TraceParams {
    TraceParams { position: Vec3::new(0.2, -0.3, 0.1), max_depth, ..room.params(size) }
}
