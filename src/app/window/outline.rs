//! Lines in the scene, and the edges of a box, as a camera sees them: pure, in f64.

use glam::{DVec2, DVec3, UVec2};

use super::navigate::axes;
use crate::components::Camera;

/// What is nearer than this part of the box's size is cut off: it has no place on the film.
const NEAREST: f64 = 1e-4;

/// The twelve edges of the box between `low` and `high`, world space, as far as they are before the camera: both ends in pixels of the
/// whole film, from its top left. A box without corners has none.
pub fn edges(camera: &Camera, film: UVec2, low: DVec3, high: DVec3) -> Vec<[DVec2; 2]> {
    let size = (high - low).length();
    if !(low.cmple(high).all() && size.is_finite()) {
        return Vec::new();
    }
    let nearest = (NEAREST * size).max(f64::MIN_POSITIVE);
    let corner = |index: usize| {
        let pick = |axis: usize| if index >> axis & 1 == 1 { high[axis] } else { low[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let pairs = (0..8usize).flat_map(|from| [1, 2, 4].map(|bit| (from, from | bit))).filter(|(from, to)| from != to);
    pairs.filter_map(|(from, to)| segment(camera, film, [corner(from), corner(to)], nearest)).collect()
}

/// A line between two points, world space, as far as it is farther before the camera than `nearest`, above 0: both ends in pixels of the whole film, from its
/// top left.
pub fn segment(camera: &Camera, film: UVec2, ends: [DVec3; 2], nearest: f64) -> Option<[DVec2; 2]> {
    let frame = axes(camera);
    let [from, to] = ends.map(|end| DVec3::from(frame.map(|axis| (end - camera.position).dot(axis))));
    let cut = |from: DVec3, to: DVec3| match from.z < nearest {
        true => from + (to - from) * ((nearest - from.z) / (to.z - from.z)),
        false => from,
    };
    let is_before = from.z.max(to.z) > nearest;
    is_before.then(|| [cut(from, to), cut(to, from)].map(|point| project(camera, film, point)))
}

/// Where a point is on the film, pixels from its top left. The point is in the camera's axes, before it: right, up and forward.
fn project(camera: &Camera, film: UVec2, point: DVec3) -> DVec2 {
    let film = film.as_dvec2();
    let half = (0.5 * camera.fov_y.to_radians()).tan();
    // Half heights of the picture, from its middle.
    let at = point.truncate() / (point.z * half) - 2.0 * camera.lens.shift;
    0.5 * (film + DVec2::new(at.x, -at.y) * film.y)
}
