//! Tangent space by MikkTSpace, which maps of directions are made for (Mikkelsen 2008).

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{DAffine3, DVec3};

use crate::components::MeshData;

/// Along u, at the corners of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Tangents {
    /// World space, unit length.
    corners: [DVec3; 3],
    /// 1 or -1: v grows along `cross(normal, tangent)`, or against it.
    turn: f64,
}

impl Tangents {
    /// Those of a mesh's triangles; none where it has no texture coordinates, or they leave no direction.
    pub fn of(mesh: &MeshData, transform: &DAffine3) -> Vec<Option<Self>> {
        let mut spaces = vec![None; 3 * mesh.triangles.len()];
        if mesh.triangles.is_empty() || mesh.uv_triangles.len() != mesh.triangles.len() {
            return vec![None; mesh.triangles.len()];
        }
        // It has no way to fail.
        let _ = generate_tangents(&mut Finder { mesh, spaces: &mut spaces });
        // A mirror keeps normals that a mesh brings on the side where they were, and turns the cross product; of a mesh
        // without any it turns the normals too.
        let mirrors = transform.matrix3.determinant() < 0.0 && !mesh.normal_triangles.is_empty();
        let of_triangle = |spaces: &[Option<(DVec3, f64)>]| {
            let (first, turn) = spaces[0]?;
            let along = [first, spaces[1]?.0, spaces[2]?.0].map(|t| (transform.matrix3 * t).normalize_or_zero());
            let turn = if mirrors { -turn } else { turn };
            (!along.contains(&DVec3::ZERO)).then_some(Self { corners: along, turn })
        };
        spaces.chunks_exact(3).map(of_triangle).collect()
    }

    /// A direction of tangent space in world space, about a unit normal there, at weights of the second and third corner.
    pub fn bend(&self, local: DVec3, normal: DVec3, b: [f64; 2]) -> DVec3 {
        let [p, q, r] = self.corners;
        let along = (1.0 - b[0] - b[1]) * p + b[0] * q + b[1] * r;
        let along = along - along.dot(normal) * normal;
        if along.length_squared() < 1e-6 {
            return normal;
        }
        let tangent = along.normalize();
        let bitangent = self.turn * normal.cross(tangent);
        (local.x * tangent + local.y * bitangent + local.z * normal).normalize()
    }
}

struct Finder<'a> {
    mesh: &'a MeshData,
    /// Of each corner: along u, and 1 or -1.
    spaces: &'a mut [Option<(DVec3, f64)>],
}

impl Geometry for Finder<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.positions[self.mesh.triangles[face][vert] as usize].as_vec3().to_array()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        if let Some(corners) = self.mesh.normal_triangles.get(face) {
            return self.mesh.normals[corners[vert] as usize].to_array();
        }
        let [a, b, c] = self.mesh.triangles[face].map(|corner| self.mesh.positions[corner as usize]);
        (b - a).cross(c - a).normalize_or_zero().as_vec3().to_array()
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.mesh.uvs[self.mesh.uv_triangles[face][vert] as usize].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, vert: usize) {
        let sign = |space: &TangentSpace| if space.is_orientation_preserving() { 1.0 } else { -1.0 };
        let found = space.map(|space| (DVec3::from(space.tangent().map(f64::from)), sign(&space)));
        self.spaces[3 * face + vert] = found;
    }
}
