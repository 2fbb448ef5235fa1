//! Meshes as PLY files: world space, a vertex for each corner that differs from the others.

use std::collections::HashMap;
use std::io::{self, Write};

use glam::{DAffine3, DVec3, Vec2, Vec3};

use crate::components::MeshData;

/// Triangles with shared corners, world space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
    pub has_normals: bool,
    has_uvs: bool,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    position: DVec3,
    normal: Vec3,
    uv: Vec2,
}

impl Mesh {
    /// A mesh in its place. `smooth` has it keep its normals.
    pub fn new(data: &MeshData, place: &DAffine3, smooth: bool) -> Self {
        let has_normals = smooth && !data.normal_triangles.is_empty();
        let has_uvs = !data.uv_triangles.is_empty();
        let turn = place.matrix3.inverse().transpose();
        let mut mesh = Self { has_normals, has_uvs, ..Self::default() };
        let mut known: HashMap<([u32; 3], [u32; 3]), u32> = HashMap::new();
        for (index, triangle) in data.triangles.iter().enumerate() {
            let positions = triangle.map(|i| place.transform_point3(data.positions[i as usize]));
            let winding = (positions[1] - positions[0]).cross(positions[2] - positions[0]).normalize_or_zero();
            let normals = has_normals
                .then(|| data.normal_triangles[index])
                .map(|corners| corners.map(|i| (turn * data.normals[i as usize].as_dvec3()).normalize_or_zero()));
            // A corner without a normal has its whole triangle flat.
            let normals = normals.filter(|all| !all.contains(&DVec3::ZERO)).unwrap_or([winding; 3]);
            let uvs = data.uv_triangles.get(index).map_or([Vec2::ZERO; 3], |c| c.map(|i| data.uvs[i as usize]));
            mesh.triangles.push(std::array::from_fn(|k| {
                let (normal, uv) = (if has_normals { normals[k].as_vec3() } else { Vec3::ZERO }, uvs[k]);
                let bits = [triangle[k], normal.x.to_bits(), normal.y.to_bits()];
                let key = (bits, [normal.z.to_bits(), uv.x.to_bits(), uv.y.to_bits()]);
                *known.entry(key).or_insert_with(|| {
                    mesh.corners.push(Corner { position: positions[k], normal, uv });
                    mesh.corners.len() as u32 - 1
                })
            }));
        }
        mesh
    }

    /// The other side of it, so far behind: its triangles face the other way.
    pub fn back(&self, behind: f64) -> Self {
        let mut back = Self { has_uvs: self.has_uvs, ..Self::default() };
        for triangle in &self.triangles {
            let corners = triangle.map(|i| self.corners[i as usize]);
            let [a, b, c] = corners.map(|corner| corner.position);
            let shift = (b - a).cross(c - a).normalize_or_zero() * -behind;
            let first = back.corners.len() as u32;
            back.corners.extend(corners.map(|corner| Corner { position: corner.position + shift, ..corner }));
            back.triangles.push([first, first + 2, first + 1]);
        }
        back
    }

    pub fn positions(&self) -> impl Iterator<Item = DVec3> {
        self.corners.iter().map(|corner| corner.position)
    }

    /// Writes it as a binary PLY file.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let properties =
            |names: &[&str]| names.iter().map(|name| format!("property float {name}\n")).collect::<String>();
        let mut head = format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", self.corners.len());
        head += &properties(&["x", "y", "z"]);
        if self.has_normals {
            head += &properties(&["nx", "ny", "nz"]);
        }
        if self.has_uvs {
            head += &properties(&["u", "v"]);
        }
        head += &format!("element face {}\nproperty list uchar int vertex_indices\nend_header\n", self.triangles.len());
        out.write_all(head.as_bytes())?;
        let mut put = |values: &[f32]| values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()));
        for corner in &self.corners {
            put(&corner.position.as_vec3().to_array())?;
            if self.has_normals {
                put(&corner.normal.to_array())?;
            }
            if self.has_uvs {
                put(&corner.uv.to_array())?;
            }
        }
        for triangle in &self.triangles {
            out.write_all(&[3])?;
            triangle.iter().try_for_each(|index| out.write_all(&index.to_le_bytes()))?;
        }
        Ok(())
    }
}
