//! What building and walking the tree share: triangles, boxes, nodes, and how a node names its children.
//!
//! `n` triangles make `n` leaves and `n - 1` nodes, the root first; see [`root`] for the small cases.

use glam::{Vec3, Vec4};

gpu_consts! {
    /// Set in a child's word: the other bits are a leaf's index, not a node's.
    pub const LEAF_BIT: u32 = 0x8000_0000;
    /// The word of a child or parent that is not there.
    pub const NO_ROOT: u32 = 0xffff_ffff;

    /// Words of `centroid_bounds` as `array<u32>`. Each of its four quantities is x, y, z and an unused word, so that
    /// it can be read as `array<vec4<u32>>` at a quarter of these indices. Words hold `ordered_bits` of a float
    /// (module `lib/ordered`), those of a least value complemented: each is a maximum, and all start from zero.
    pub const BOUNDS_WORDS: u32 = 16;
    /// First word of the least centroid, complemented.
    pub const CENTROID_LOW: u32 = 0;
    /// First word of the greatest centroid.
    pub const CENTROID_HIGH: u32 = 4;
    /// First word of the scene box's least corner, complemented.
    pub const SCENE_LOW: u32 = 8;
    /// First word of the scene box's greatest corner.
    pub const SCENE_HIGH: u32 = 12;

    /// Bits of a Morton code along each axis.
    pub const MORTON_BITS: u32 = 21;
    /// Triangles that each thread of the bounds pass reads.
    pub const BOUNDS_PER_THREAD: u32 = 8;
    /// Levels of the pyramid of boxes that one dispatch builds.
    pub const PYRAMID_LEVELS: u32 = 9;
}

gpu_struct! {
    /// A triangle in world space, scene units, relative to the scene's origin; corners finite, in the order of the file.
    pub struct Triangle {
        /// First corner.
        pub a: Vec3,
        /// Index of this triangle in scene order, wherever it is stored.
        pub index: u32,
        /// Second corner.
        pub b: Vec3,
        /// Index of its material.
        pub material: u32,
        /// Third corner.
        pub c: Vec3,
        /// Unused, 0.
        pub flags: u32,
    }
}

gpu_struct! {
    /// The box of an aligned run of leaves: one element of the pyramid `boxes`.
    pub struct LeafBox {
        /// Least corner; w is 0.
        pub low: Vec4,
        /// Greatest corner; w is 0.
        pub high: Vec4,
    }
}

gpu_struct! {
    /// An inner node with the boxes of its two children, as (left min, left max, right min, right max) along each axis.
    pub struct Node {
        /// Extents along x.
        pub x: Vec4,
        /// Extents along y.
        pub y: Vec4,
        /// Extents along z.
        pub z: Vec4,
        /// Left child: a node, or `LEAF_BIT` and a leaf.
        pub left: u32,
        /// Right child: a node, or `LEAF_BIT` and a leaf.
        pub right: u32,
        /// Leaves below this node, at least 2. They are consecutive.
        pub leaves: u32,
        /// The node above; `NO_ROOT` for the root.
        pub parent: u32,
    }
}

gpu_struct! {
    /// Parameters of the passes that run once over all triangles.
    pub struct BuildParams {
        /// Number of triangles.
        pub count: u32,
    }
}

gpu_struct! {
    /// Parameters of one dispatch of the pyramid.
    pub struct PyramidParams {
        /// First box of the level that is read.
        pub source: u32,
        /// Number of boxes of that level.
        pub count: u32,
    }
}

/// The word that names the root of a tree over `count` triangles: node 0, the only leaf, or nothing.
pub fn root(count: u32) -> u32 {
    match count {
        0 => NO_ROOT,
        1 => LEAF_BIT,
        _ => 0,
    }
}

/// Number of nodes of a tree over `count` triangles.
pub fn node_count(count: u32) -> u32 {
    count.saturating_sub(1)
}
