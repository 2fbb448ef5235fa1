//! Models of which nothing will be seen, and why: said where it is certain, at the cost of a look at each corner.

use std::path::Path;

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::description::{MeshEntry, SceneDescription};
use super::diagnostic::{Diagnostic, Severity};
use crate::components::{Camera, Lens, MeshData};

/// Triangles whose height is less than this part of their longest side have no area: their corners, of 53 bits, lie on a line.
const FLAT: f64 = 1e-15;

/// Where a camera sees nothing of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// All of it is behind the camera.
    Behind,
    /// All of it is behind the camera, or beyond one edge of the picture.
    Outside,
}

/// Why nothing of the model of a name can be seen by any camera.
pub fn unseen_model(description: &SceneDescription, name: &str) -> Option<String> {
    let mut meshes =
        description.meshes.iter().filter(|(key, _)| model_of(key) == name).map(|(_, mesh)| mesh).peekable();
    meshes.peek()?;
    let visible: Vec<&MeshEntry> = meshes.filter(|mesh| !is_hidden(description, mesh)).collect();
    let why = if visible.is_empty() {
        "its materials are invisible (`d 0`, or `Tr 1`)"
    } else if visible.iter().all(|mesh| is_flat(&mesh.geometry)) {
        "its triangles have no area"
    } else {
        return None;
    };
    Some(format!("nothing of this model will be seen: {why}"))
}

/// Whether a camera sees nothing of the scene's models, though there are some that could be seen. Judged by the boxes around meshes, so
/// that what is said is certain.
pub fn beyond(description: &SceneDescription, camera: &Camera) -> Option<Beyond> {
    let view = View::new(camera, description.film.size.as_dvec2());
    let mut found = None;
    for mesh in description.meshes.values().filter(|mesh| !is_hidden(description, mesh)) {
        let corners = bounds(&mesh.geometry)?.map(|corner| mesh.transform.0.transform_point3(corner));
        let here = view.beyond(&corners)?;
        // All that is behind, and else beyond one edge or another.
        found = Some(if here == Beyond::Behind && found != Some(Beyond::Outside) { here } else { Beyond::Outside });
    }
    found
}

/// A warning that a camera sees nothing, if so; `file` is the scene's.
pub fn unseen_by(description: &SceneDescription, camera: &str, file: &Path) -> Option<Diagnostic> {
    let found = beyond(description, description.cameras.get(camera)?)?;
    let mut models: Vec<&str> = description.meshes.keys().map(|key| model_of(key)).collect();
    models.dedup();
    let what = if models.len() == 1 { "this model" } else { "these models" };
    let why = match found {
        Beyond::Behind => format!("all is behind the camera `{camera}`"),
        Beyond::Outside => format!("all is outside of the view of the camera `{camera}`"),
    };
    let message = format!("nothing of {what} will be seen: {why}");
    Some(Diagnostic::file(Severity::Warning, file, message).help("check its `position`, `look_at` and `fov_y`"))
}

/// The model that a mesh is of.
fn model_of(mesh: &str) -> &str {
    mesh.split_once('/').map_or(mesh, |(model, _)| model)
}

fn is_hidden(description: &SceneDescription, mesh: &MeshEntry) -> bool {
    description.materials.get(&mesh.material).is_some_and(|material| material.material().is_invisible())
}

/// Whether no triangle has an area.
fn is_flat(mesh: &MeshData) -> bool {
    mesh.triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        // By their own size, so that no product underflows.
        let size = (b - a).abs().max((c - a).abs()).max_element();
        let (u, v) = ((b - a) / size, (c - a) / size);
        size == 0.0 || u.cross(v).length() <= FLAT
    })
}

/// The corners of the box around a mesh; none where it has no points.
fn bounds(mesh: &MeshData) -> Option<[DVec3; 8]> {
    let bounds = Bounds::of(mesh.positions.iter().copied());
    (!bounds.is_empty()).then(|| bounds.corners())
}

/// What a camera sees: the space in front of it, between four planes through it.
struct View {
    position: DVec3,
    forward: DVec3,
    /// Normals, inwards.
    sides: [DVec3; 4],
    /// Radius of the lens, and distance of what it shows sharp.
    aperture: f64,
    focus: f64,
}

impl View {
    /// By the whole film, pixels.
    fn new(camera: &Camera, film: DVec2) -> Self {
        let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up).normalize_or(forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let half = (0.5 * camera.fov_y.to_radians()).tan();
        let (x, y) = (half * film.x / film.y, half);
        let Lens { aperture, shift, .. } = camera.lens;
        let middle = 2.0 * half * shift;
        let sides = [
            forward * (x + middle.x) - right,
            forward * (x - middle.x) + right,
            forward * (y + middle.y) - up,
            forward * (y - middle.y) + up,
        ];
        let (position, focus) = (camera.position, camera.focus_distance());
        Self { position, forward, sides: sides.map(DVec3::normalize), aperture, focus }
    }

    /// Where a box is, if nothing of it is in view. What touches an edge is in view, as near as numbers tell.
    fn beyond(&self, corners: &[DVec3; 8]) -> Option<Beyond> {
        let slack = 1e-12 * corners.iter().fold(self.position.length(), |most, corner| most.max(corner.length()));
        let ahead = |corner: &DVec3| self.forward.dot(*corner - self.position);
        if corners.iter().all(|corner| ahead(corner) <= 0.0) {
            return Some(Beyond::Behind);
        }
        let is_beyond =
            |side: &DVec3, corner: &DVec3| side.dot(*corner - self.position) <= -slack - self.blur(ahead(corner));
        self.sides.iter().any(|side| corners.iter().all(|corner| is_beyond(side, corner))).then_some(Beyond::Outside)
    }

    /// How far beyond the edges of the picture a lens sees, so far ahead.
    fn blur(&self, ahead: f64) -> f64 {
        if self.aperture > 0.0 && self.focus > 0.0 { self.aperture * (1.0 - ahead / self.focus).abs() } else { 0.0 }
    }
}
