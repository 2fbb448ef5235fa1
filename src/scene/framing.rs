//! The camera of scenes that have none: all is in its view.

use std::collections::BTreeMap;

use glam::{DVec3, UVec2};

use super::bounds::Bounds;
use super::description::{MeshEntry, SceneDescription};
use super::file::DEFAULT_CAMERA;
use crate::components::Camera;

/// Towards the camera: a three-quarter view, from the front (+z), the right and above.
const FROM: DVec3 = DVec3::new(0.7, 0.5, 1.0);

/// Vertical, degrees.
const FOV_Y: f64 = 40.0;

/// The part of the picture, from its middle to its edge, that may be filled.
const FILLED: f64 = 0.92;

/// Radii that the nearest point is away from the camera, at least.
const NEAREST: f64 = 0.05;

/// A camera as near as it sees all points of triangles, in a picture of such a size: they lie in its middle.
pub fn framing(meshes: &BTreeMap<String, MeshEntry>, size: UVec2) -> Camera {
    let points = || {
        meshes.values().flat_map(|mesh| {
            let used = mesh.geometry.triangles.iter().flatten();
            used.map(|index| mesh.transform.0.transform_point3(mesh.geometry.positions[*index as usize]))
        })
    };
    let bounds = Bounds::of(points());
    let Bounds { low, high } = bounds;
    let (centre, radius) = match bounds.is_empty() {
        true => (DVec3::ZERO, 1.0),
        false => (low + 0.5 * (high - low), (0.5 * (high - low).length()).max(1e-9)),
    };
    let forward = -FROM.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let half = FILLED * (0.5 * FOV_Y.to_radians()).tan();
    let slopes = [half * f64::from(size.x) / f64::from(size.y), half];
    // What the camera's place may be at most along each plane at an edge of the picture, so that all points are on its inner side.
    let mut most = [[0.0f64; 2]; 2];
    let mut nearest = f64::INFINITY;
    for (i, point) in points().map(|point| point - centre).enumerate() {
        let ahead = point.dot(forward);
        nearest = nearest.min(ahead);
        for (most, (slope, side)) in most.iter_mut().zip(slopes.into_iter().zip([right, up])) {
            let across = point.dot(side);
            let inner = [ahead * slope + across, ahead * slope - across];
            *most = if i == 0 { inner } else { [most[0].min(inner[0]), most[1].min(inner[1])] };
        }
    }
    let [[left, other], [bottom, top]] = most;
    let back = match bounds.is_empty() {
        true => -radius / half,
        false => [(left + other) / (2.0 * slopes[0]), (bottom + top) / (2.0 * slopes[1]), nearest - NEAREST * radius]
            .into_iter()
            .fold(f64::INFINITY, f64::min),
    };
    // In the middle between planes that face each other.
    let position = centre + back * forward + 0.5 * (left - other) * right + 0.5 * (bottom - top) * up;
    let look_at = position + forward * (centre - position).dot(forward).max(radius * NEAREST);
    Camera { position, look_at, fov_y: FOV_Y, ..Camera::default() }
}

/// Fits the view of a scene without cameras to the size that its picture has now, where that was of another `size`.
pub fn reframe(description: &mut SceneDescription, size: UVec2) {
    if size == description.film.size || description.cameras.len() != 1 {
        return;
    }
    if let Some(camera) = description.cameras.get_mut(DEFAULT_CAMERA)
        && *camera == framing(&description.meshes, size)
    {
        *camera = framing(&description.meshes, description.film.size);
    }
}
