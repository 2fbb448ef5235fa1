//! What an OBJ file lists: vertices, texture coordinates and normals, and the corners of faces that refer to them.

use std::ops::Range;

use glam::{DVec3, Vec2, Vec3};

/// The values that corners refer to, in the order of the file.
#[derive(Debug, Default)]
pub struct Values {
    /// Model space.
    pub positions: Vec<DVec3>,
    pub uvs: Vec<Vec2>,
    /// Of unit length, or zero where the file's has no direction.
    pub normals: Vec<Vec3>,
}

impl Values {
    /// How many there are.
    pub fn counts(&self) -> Counts {
        [self.positions.len(), self.uvs.len(), self.normals.len()].map(|count| count as u32)
    }
}

/// Numbers of vertices, texture coordinates and normals, in that order; or what is said of each of these three.
pub type Counts = [u32; 3];

/// The corners of faces, as they are written: an index from 1, or a negative one, back from the end of what came before its line.
#[derive(Debug, Default)]
pub struct Corners {
    /// Of vertices, texture coordinates and normals. The last two of those faces alone that have them.
    pub indices: [Vec<i32>; 3],
    /// Corners of each face.
    pub arities: Vec<u16>,
}

/// Faces that follow each other in a list of corners and have the same attributes.
#[derive(Clone, Debug)]
pub struct FaceRun {
    /// Which list.
    pub source: u32,
    /// Faces, by their numbers in the list.
    pub faces: Range<u32>,
    /// Where their corners begin in the list's indices, and how many there are.
    pub starts: [u32; 3],
    pub corners: u32,
    /// Values that came before these faces: what negative indices count back from.
    pub before: Counts,
}

/// What an index as it is written comes to, from 0.
pub fn resolved(index: i32, before: u32) -> u32 {
    if index < 0 { before.wrapping_add_signed(index) } else { index as u32 - 1 }
}
