//! Meshes: shared geometry, its place in the world, and the material it is made of.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, Vec2, Vec3};

/// Triangles as a file holds them: shared corners, model space.
///
/// `normals` and `uvs` have their own index lists, each empty where the file gives none, else one entry a triangle.
/// Every index is within its list, and every number is finite: whoever makes a `MeshData` sees to both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Model space, scene units.
    pub positions: Vec<DVec3>,
    /// Three positions a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Model space, unit length.
    pub normals: Vec<Vec3>,
    /// Three normals a triangle, or empty: then the face's own normal is used.
    pub normal_triangles: Vec<[u32; 3]>,
    /// Texture coordinates, v up.
    pub uvs: Vec<Vec2>,
    /// Three texture coordinates a triangle, or empty.
    pub uv_triangles: Vec<[u32; 3]>,
}

/// The shared geometry of a mesh.
#[derive(Component, Clone, Debug)]
pub struct Geometry(pub Arc<MeshData>);

/// Model space to world space. Finite; may mirror, may not be singular.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Transform(pub DAffine3);

impl Default for Transform {
    fn default() -> Self {
        Self(DAffine3::IDENTITY)
    }
}

/// The material entity of a mesh.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct UsesMaterial(pub Entity);
