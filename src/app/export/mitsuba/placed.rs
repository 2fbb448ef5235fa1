//! The meshes of a scene where they are seen, and what lies around them.

use std::borrow::Cow;

use glam::{DVec3, Vec3};

use super::mesh::Mesh;
use crate::scene::{MtlMaterial, SceneDescription};

/// How far the two sides of a lamp that shines both ways are apart, by the greatest coordinate of it.
const APART: f64 = 3e-5;

/// A mesh in world space, and what it is of.
pub struct PlacedMesh<'a> {
    pub name: &'a String,
    pub material: &'a String,
    pub numbers: &'a MtlMaterial,
    pub mesh: Mesh,
}

impl PlacedMesh<'_> {
    /// Whether it is a lamp.
    pub fn shines(&self) -> bool {
        self.numbers.ke != Vec3::ZERO
    }

    /// The mesh, and where it shines to both sides another one for its back, with what tells their names apart: an emitter of Mitsuba's
    /// shines to the front alone.
    pub fn sides(&self) -> Vec<(Cow<'_, Mesh>, &'static str)> {
        let front = (Cow::Borrowed(&self.mesh), "");
        if !self.shines() || self.numbers.one_sided {
            return vec![front];
        }
        let far = self.mesh.positions().fold(0.0f64, |far, p| far.max(p.abs().max_element()));
        vec![front, (Cow::Owned(self.mesh.back(APART * far)), "-back")]
    }
}

/// All meshes that are seen. Those that emit light are flat: Mitsuba would have them shine by their normals.
pub fn placed_meshes(scene: &SceneDescription) -> Vec<PlacedMesh<'_>> {
    let seen = scene.meshes.iter().filter_map(|(name, entry)| {
        let numbers = scene.materials.get(&entry.material)?;
        let material = numbers.material();
        if material.is_invisible() || entry.geometry.triangles.is_empty() {
            return None;
        }
        let mesh = Mesh::new(&entry.geometry, &entry.transform.0, material.emission == Vec3::ZERO);
        Some(PlacedMesh { name, material: &entry.material, numbers, mesh })
    });
    seen.collect()
}

/// A point and a radius around it that has all meshes, point lights and the camera.
pub fn around(scene: &SceneDescription, meshes: &[PlacedMesh]) -> (DVec3, f64) {
    let camera = scene.cameras.get(&scene.active).map(|camera| camera.position);
    let points = || {
        let corners = meshes.iter().flat_map(|placed| placed.mesh.positions());
        corners.chain(scene.lights.values().map(|light| light.position)).chain(camera)
    };
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    if low.is_finite() { (0.5 * (low + high), 0.5 * (high - low).length()) } else { (DVec3::ZERO, 1.0) }
}
