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
    /// Cells from the origin to [`BuildParams::core`], in a scene that reaches beyond that.
    pub const CORE_CELLS: u32 = 0x8_0000;
    /// By how many bits a float's bits are shifted to number the cells beyond the core: 2^11 cells an octave.
    pub const OCTAVE_SHIFT: u32 = 12;
    /// Triangles that each thread of the bounds pass reads.
    pub const BOUNDS_PER_THREAD: u32 = 8;
    /// Levels of the pyramid of boxes that one dispatch builds.
    pub const PYRAMID_LEVELS: u32 = 9;

    /// A treelet has up to so many leaves, or clusters that are settled already: as many as a workgroup has threads.
    pub const TREELET_SIZE: u32 = 256;
    /// Clusters of a treelet look for the nearest among those up to so many places away.
    pub const TREELET_RADIUS: u32 = 4;
    /// Turns in which clusters of a treelet choose. What they leave is joined in the order of its places, or shells in shells would make a chain.
    pub const TREELET_TURNS: u32 = 20;
    /// Sides of boxes are at most this when surfaces are compared, scene units: their products are finite.
    pub const TREELET_LONGEST: f32 = 1e19;
    /// Surfaces below this (2^-100) are none: then differences of surfaces are normal numbers, which no device flushes to 0.
    pub const TREELET_LEAST_AREA: f32 = 7.888609e-31;
    /// By how many times treelets of the next level are larger.
    pub const TREELET_GROWTH: u32 = 8;
    /// A treelet has at most so many times the leaves of its largest cluster: half of `TREELET_SIZE`, for few clusters are as large as they may be.
    pub const TREELET_PART: u32 = 128;
    /// Levels of treelets, at most; the last has whole trees of 2^29 leaves.
    pub const TREELET_LEVELS: u32 = 8;

    /// Paths among so few triangles look at every leaf (`traverse_few.wgsl`): a bit for each in one word.
    pub const FEW_TRIANGLES: u32 = 32;
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
        /// Leaves below this node, at least 2.
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
        /// What [`core_radius`] says of them, scene units.
        pub core: f32,
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

gpu_struct! {
    /// Parameters of a dispatch over the treelets of a level.
    pub struct TreeletParams {
        /// The level, whose number of roots is this word of `treelets`.
        pub level: u32,
        /// Where its roots begin there.
        pub first: u32,
        /// Leaves of the clusters, at most.
        pub below: u32,
        /// Unused, 0.
        pub pad: u32,
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

/// Subtrees of about one size, which are joined anew in one dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeletLevel {
    /// Leaves of one, at most; its parent has more.
    pub limit: u32,
    /// Leaves of one, at least, less one: those of the level before.
    pub before: u32,
    /// Leaves of the clusters that it is joined of, at most.
    pub below: u32,
    /// Where the roots of this level begin in `treelets`, as words.
    pub first: u32,
}

/// The levels of treelets of a tree over `count` triangles, from the leaves to the whole of it.
pub fn treelet_levels(count: u32) -> impl Iterator<Item = TreeletLevel> {
    let lowest = TreeletLevel { limit: TREELET_SIZE, before: 2, below: 1, first: TREELET_LEVELS };
    let next = move |level: &TreeletLevel| {
        (level.limit < count).then(|| TreeletLevel {
            limit: level.limit * TREELET_GROWTH,
            before: level.limit,
            below: level.limit * TREELET_GROWTH / TREELET_PART,
            first: level.first + count / (level.before + 1),
        })
    };
    std::iter::successors((count > 2).then_some(lowest), next)
}

/// Words of `treelets` for a tree over `count` triangles: how many roots each level has, then the roots of each.
pub fn treelet_words(count: u32) -> u32 {
    treelet_levels(count).last().map_or(TREELET_LEVELS, |last| last.first + count / (last.before + 1))
}

/// Triangles that [`core_radius`] samples, at most.
const SAMPLED: u32 = 4096;

/// One in so many triangles lies within what [`core_radius`] takes for the size of the scene.
const INNERMOST: usize = 256;

/// The distance from the origin up to which Morton cells are of one size: a power of two, so that cells are found without rounding.
///
/// It is 256 times the distance, by the greatest coordinate, within which one of 256 triangles has its centre: more than
/// any scene has that fills its box, of volumes, surfaces or a line. So cells are the box's there; but where a few things, or a sky's
/// dome, are a million times farther than all else, that is not all in one cell. `centre_of` is called for some 4096 of the triangles,
/// spread evenly over `count`.
pub fn core_radius(count: u32, centre_of: impl FnMut(u32) -> Vec3) -> f32 {
    let samples = count.min(SAMPLED);
    let index = |i: u32| (u64::from(i) * u64::from(count) / u64::from(samples)) as u32;
    let mut distances: Vec<f32> = (0..samples).map(index).map(centre_of).map(|c| c.abs().max_element()).collect();
    if distances.is_empty() {
        return f32::MIN_POSITIVE;
    }
    let (_, inner, _) = distances.select_nth_unstable_by(samples as usize / INNERMOST, f32::total_cmp);
    // The power of two above it, times 2^8, of what a float can be.
    let exponent = ((inner.to_bits() >> 23) + 9).clamp(1, 254);
    f32::from_bits(exponent << 23)
}
