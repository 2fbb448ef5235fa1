//! The mathematics of moving a camera. Pure functions of a camera, all in f64, so that they can be tested by themselves.
//!
//! "Right" and "up" are those of the picture. Every result is a camera that the scene reader would accept, as long as the
//! first one is.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec2, DVec3};

use crate::components::{Camera, Focus, Lens};

/// Radians that an orbit stays away from the poles, where the picture would turn over.
const POLE_MARGIN: f64 = 0.01;

/// The camera's own axes: right, up and forward, unit length.
pub(super) fn axes(camera: &Camera) -> [DVec3; 3] {
    let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
    let right = forward.cross(camera.up).normalize_or(forward.any_orthonormal_vector());
    [right, right.cross(forward), forward]
}

/// Distance of the point that is looked at.
pub fn distance(camera: &Camera) -> f64 {
    camera.position.distance(camera.look_at)
}

/// Turns about the point that is looked at. `angle` in radians: the scene seems to follow a hand that goes right and down.
/// Keeps the distance; ends short of the poles of the camera's `up`.
pub fn orbit(camera: Camera, angle: DVec2) -> Camera {
    let pole = camera.up.normalize_or(DVec3::Y);
    let offset = camera.position - camera.look_at;
    let distance = offset.length();
    let height = offset.dot(pole);
    let level = (offset - height * pole).normalize_or(pole.any_orthonormal_vector());
    let level = DQuat::from_axis_angle(pole, -angle.x) * level;
    let most = FRAC_PI_2 - POLE_MARGIN;
    let elevation = (height / distance).clamp(-1.0, 1.0).asin();
    // A camera that already looks steeper than an orbit may is not thrown back.
    let (sin, cos) = (elevation + angle.y).clamp(-most.max(-elevation), most.max(elevation)).sin_cos();
    Camera { position: camera.look_at + distance * (cos * level + sin * pole), ..camera }
}

/// Moves camera and target alike, across the view. `shift` is in heights of the picture, right and down: the point that is
/// looked at stays under the hand.
pub fn pan(camera: Camera, shift: DVec2) -> Camera {
    let [right, up, _] = axes(&camera);
    let height = 2.0 * (0.5 * camera.fov_y.to_radians()).tan() * distance(&camera);
    translate(camera, height * (shift.y * up - shift.x * right))
}

/// Multiplies the distance to the target by `factor`, above 0, and keeps it between `closest` and `farthest`: never past it.
pub fn zoom(camera: Camera, factor: f64, [closest, farthest]: [f64; 2]) -> Camera {
    let from = distance(&camera);
    // Whoever is closer already may leave, and not come nearer still; and the same far away.
    let to = (from * factor).max(closest.min(from)).min(farthest.max(from));
    Camera { position: camera.look_at + (camera.position - camera.look_at) * (to / from), ..camera }
}

/// Moves camera and target alike by `step`: right, up and forward, scene units. Up is the scene's, so that flying over a
/// ground keeps its height whatever the view.
pub fn fly(camera: Camera, step: DVec3) -> Camera {
    let [right, _, forward] = axes(&camera);
    translate(camera, step.x * right + step.y * camera.up.normalize_or(DVec3::Y) + step.z * forward)
}

/// Moves to where all of the box between `low` and `high` is seen, the direction unchanged, with the box in the middle of the picture. `aspect`
/// is the film's width by its height. A box without corners changes nothing.
pub fn frame(camera: Camera, low: DVec3, high: DVec3, aspect: f64) -> Camera {
    let radius = 0.5 * (high - low).length();
    if !(low.cmple(high).all() && radius.is_finite() && radius > 0.0) {
        return camera;
    }
    let half = (0.5 * camera.fov_y.to_radians()).tan();
    let [right, up, forward] = axes(&camera);
    let centre = 0.5 * (low + high);
    let shift = 2.0 * half * camera.lens.shift;
    // How far ahead a ball along the middle of the picture must be, to be within the planes that are its edges.
    let ahead = |middle: f64, edge: f64| 1.0f64.hypot(middle.abs() + edge) / edge;
    let distance = radius * ahead(shift.x, half * aspect).max(ahead(shift.y, half));
    let position = centre - distance * (forward + shift.x * right + shift.y * up);
    Camera { position, look_at: position + distance * forward, ..camera }
}

/// Focuses to what is so far away along the viewing axis.
pub fn focus(camera: Camera, distance: f64) -> Camera {
    let [nearest, farthest] = Lens::FOCUS_RANGE;
    let focus = Focus::Distance(distance.clamp(nearest, farthest));
    Camera { lens: Lens { focus, ..camera.lens }, ..camera }
}

fn translate(camera: Camera, by: DVec3) -> Camera {
    Camera { position: camera.position + by, look_at: camera.look_at + by, ..camera }
}
