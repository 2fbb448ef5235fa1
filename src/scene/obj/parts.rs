//! tobj's meshes, joined group by group and triangulated.

use glam::{DVec3, Vec2, Vec3};

use super::faces::Group;
use crate::components::MeshData;
use crate::scene::bounds::Bounds;
use crate::scene::triangulate::Triangulator;

/// One mesh for each group that has faces, by group number, and the least and greatest coordinates of all.
///
/// tobj gives the groups as objects whose names are their numbers, in several pieces where they were passed to it so. Each piece
/// is let go as soon as it is taken over.
pub fn collect(models: Vec<tobj::Model>, groups: &[Group]) -> (Vec<(usize, MeshData)>, Bounds) {
    let mut meshes = vec![MeshData::default(); groups.len()];
    let mut triangulator = Triangulator::default();
    for model in models {
        if let Some(number) = model.name.parse::<usize>().ok().filter(|number| *number < groups.len()) {
            Joining { group: &groups[number], mesh: &mut meshes[number], triangulator: &mut triangulator }
                .add(model.mesh);
        }
    }
    let bounds = Bounds::of(meshes.iter().flat_map(|mesh| mesh.positions.iter().copied()));
    (meshes.into_iter().enumerate().filter(|(_, mesh)| !mesh.triangles.is_empty()).collect(), bounds)
}

/// A group's mesh while its pieces are joined.
struct Joining<'a> {
    group: &'a Group,
    mesh: &'a mut MeshData,
    triangulator: &'a mut Triangulator,
}

impl Joining<'_> {
    /// Adds one piece.
    fn add(&mut self, piece: tobj::Mesh) {
        let base = [self.mesh.positions.len(), self.mesh.uvs.len(), self.mesh.normals.len()].map(|count| count as u32);
        self.mesh.positions.extend(piece.positions.chunks_exact(3).map(DVec3::from_slice));
        if self.group.uvs {
            self.mesh.uvs.extend(piece.texcoords.chunks_exact(2).map(|uv| Vec2::new(uv[0] as f32, uv[1] as f32)));
        }
        if self.group.normals {
            self.mesh.normals.extend(piece.normals.chunks_exact(3).map(unit));
        }
        let mut polygon = Vec::new();
        let mut triangles = Vec::new();
        let mut start = 0;
        let faces = if piece.face_arities.is_empty() { piece.indices.len() / 3 } else { piece.face_arities.len() };
        for face in 0..faces {
            let corners = piece.face_arities.get(face).map_or(3, |arity| *arity as usize);
            let range = start..start + corners;
            start += corners;
            let indices = &piece.indices[range.clone()];
            polygon.clear();
            polygon.extend(indices.iter().map(|index| self.mesh.positions[(base[0] + index) as usize]));
            triangles.clear();
            self.triangulator.run(&polygon, &mut triangles);
            for triangle in &triangles {
                let pick = |list: &[u32], base: u32| triangle.map(|corner| base + list[range.start + corner as usize]);
                self.mesh.triangles.push(pick(&piece.indices, base[0]));
                if self.group.uvs {
                    self.mesh.uv_triangles.push(pick(&piece.texcoord_indices, base[1]));
                }
                if self.group.normals {
                    let normals = pick(&piece.normal_indices, base[2]);
                    self.add_normals(normals);
                }
            }
        }
    }

    /// Adds the normals of the last triangle; in place of one without a direction, the triangle's own.
    fn add_normals(&mut self, mut normals: [u32; 3]) {
        let corners = self.mesh.triangles.last().map_or([0; 3], |triangle| *triangle);
        for normal in &mut normals {
            if self.mesh.normals[*normal as usize] == Vec3::ZERO {
                let [a, b, c] = corners.map(|corner| self.mesh.positions[corner as usize]);
                *normal = self.mesh.normals.len() as u32;
                self.mesh.normals.push((b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Y).as_vec3());
            }
        }
        self.mesh.normal_triangles.push(normals);
    }
}

/// A normal of unit length, or zero where it has no direction.
fn unit(normal: &[f64]) -> Vec3 {
    DVec3::from_slice(normal).normalize_or_zero().as_vec3()
}
