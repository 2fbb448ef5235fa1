//! Where triangles are in pictures: texture coordinates, and tangents.

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};

use crate::components::MeshData;
use crate::layout::texture::{CornerUvs, POINT, Tangents};
use crate::layout::trace::octahedral;

/// Of a mesh's triangles, in its own order. A mesh without texture coordinates is at (0, 0) of every picture.
pub fn corner_uvs<'a>(mesh: &'a MeshData, transform: &'a DAffine3) -> impl Iterator<Item = CornerUvs> + 'a {
    let turn: DMat3 = transform.matrix3.inverse().transpose();
    (0..mesh.triangles.len()).map(move |i| {
        let [p, q, r] = mesh.triangles[i].map(|corner| transform.transform_point3(mesh.positions[corner as usize]));
        let curvature = mesh.normal_triangles.get(i).map_or(0.0, |corners| {
            let [n, m, o] = corners.map(|corner| (turn * mesh.normals[corner as usize].as_dvec3()).normalize_or_zero());
            let turned = [((m - n), (q - p)), ((o - m), (r - q)), ((n - o), (p - r))];
            turned.iter().map(|(by, along)| by.length() / along.length().max(1e-300)).fold(0.0, f64::max)
        });
        let curvature = (curvature as f32).min(1e30);
        let Some(corners) = mesh.uv_triangles.get(i) else {
            return CornerUvs { density: POINT, curvature, ..CornerUvs::default() };
        };
        let [a, b, c] = corners.map(|corner| mesh.uvs[corner as usize]);
        let (b, c) = (b - a, c - a);
        let in_picture = f64::from(b.perp_dot(c).abs());
        let in_scene = (q - p).cross(r - p).length();
        let density = 0.5 * (in_picture / in_scene.max(1e-300)).log2();
        let density = if density.is_finite() { density.clamp(f64::from(POINT), 1000.0) as f32 } else { POINT };
        CornerUvs { a, b, c, density, curvature }
    })
}

/// Tangents of a mesh's triangles, in its own order; none where it has no texture coordinates.
pub fn tangents(mesh: &MeshData, transform: &DAffine3) -> Vec<Tangents> {
    if mesh.uv_triangles.is_empty() || mesh.triangles.is_empty() {
        return vec![Tangents::default(); mesh.triangles.len()];
    }
    let mut found = Corners { mesh, spaces: vec![None; 3 * mesh.triangles.len()] };
    // There is no error that it could return.
    let _ = generate_tangents(&mut found);
    // Without normals of its own, a mesh that is mirrored turns its front.
    let turned = transform.matrix3.determinant() < 0.0 && !mesh.normal_triangles.is_empty();
    let pack = |corners: &[Option<([f32; 3], bool)>]| {
        let word = |corner: usize| {
            let along = corners[corner].map_or(Vec3::ZERO, |(tangent, _)| Vec3::from(tangent));
            octahedral((transform.matrix3 * along.as_dvec3()).normalize_or_zero().as_vec3())
        };
        let mirrored = corners[0].is_some_and(|(_, mirrored)| mirrored != turned);
        Tangents { t0: word(0), t1: word(1), t2: word(2), mirrored: mirrored.into() }
    };
    found.spaces.chunks_exact(3).map(pack).collect()
}

/// A mesh as MikkTSpace reads it, and what it found: of each corner the tangent, and whether the picture is mirrored there.
struct Corners<'a> {
    mesh: &'a MeshData,
    spaces: Vec<Option<([f32; 3], bool)>>,
}

impl Corners<'_> {
    fn places(&self, triangle: usize) -> [DVec3; 3] {
        self.mesh.triangles[triangle].map(|corner| self.mesh.positions[corner as usize])
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.places(face)[vert].as_vec3().to_array()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        match self.mesh.normal_triangles.get(face) {
            Some(corners) => self.mesh.normals[corners[vert] as usize].to_array(),
            None => {
                let [a, b, c] = self.places(face);
                (b - a).cross(c - a).normalize_or_zero().as_vec3().to_array()
            }
        }
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        let uv: Vec2 = self.mesh.uvs[self.mesh.uv_triangles[face][vert] as usize];
        uv.to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, vert: usize) {
        self.spaces[3 * face + vert] = space.map(|space| (space.tangent(), !space.is_orientation_preserving()));
    }
}
