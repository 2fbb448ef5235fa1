//! From triangles in scene order to a tree: bounds, Morton codes, sort, leaves, pyramid of boxes, nodes, treelets.
//!
//! An LBVH by Karras 2012, whose nodes [`treelets`](super::treelets) joins anew. Boxes do not climb the tree: each is a range query over a pyramid of the sorted leaves'
//! boxes. So every pass reads only what earlier dispatches wrote, which is all the order that WGSL promises between
//! workgroups.

use super::plan::{Plan, PutBuffer};
use super::pyramid::{levels, pyramid_boxes};
use super::treelets;
use crate::cpu::tree_check::{TreeFault, TreeMeasure, measure};
use crate::cpu::{self, morton};
use crate::layout::tree::{
    BOUNDS_PER_THREAD, BOUNDS_WORDS, BuildParams, LeafBox, Node, PYRAMID_LEVELS, PyramidParams, TREELET_LEVELS,
    Triangle, node_count, root, treelet_words,
};
use crate::passes::twin::twin;
use crate::passes::{Binding, Makes, Pass, Recording, Size, clear, sort};

/// This builder.
pub static PLAN: Plan = Plan { most_triangles: MOST_TRIANGLES, buffers, record: record_triangles, root, twin, cost };

/// The box of all triangles and that of their centroids, joined to what `centroid_bounds` holds: clear it to 0 before.
pub static BOUNDS: Pass = Pass {
    name: "bounds",
    module: "passes/morton/bounds",
    entry: "bounds",
    features: &[],
    bindings: &[
        Binding::read("triangles", "array<Triangle>"),
        Binding::write("centroid_bounds", "array<atomic<u32>>"),
        Binding::params("BuildParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(morton::bounds),
};

/// A Morton code and an index for each triangle.
pub static MORTON: Pass = Pass {
    name: "morton",
    module: "passes/morton/morton",
    entry: "morton",
    features: &[],
    bindings: &[
        Binding::read("triangles", "array<Triangle>"),
        Binding::read("centroid_bounds", "array<vec4<u32>>"),
        Binding::write("keys", "array<vec2<u32>>"),
        Binding::write("payload", "array<u32>"),
        Binding::params("BuildParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(morton::codes),
};

/// Triangles in the order of their codes, and their boxes.
pub static LEAVES: Pass = Pass {
    name: "leaves",
    module: "passes/tree/leaves",
    entry: "gather_leaves",
    features: &[],
    bindings: &[
        Binding::read("triangles", "array<Triangle>"),
        Binding::read("sort_plan", "SortPlan"),
        Binding::read("payload", "array<u32>"),
        Binding::read("payload_back", "array<u32>"),
        Binding::write("leaves", "array<Triangle>"),
        Binding::write("boxes", "array<LeafBox>"),
        Binding::params("BuildParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(tree::leaves),
};

/// [`PYRAMID_LEVELS`] levels of the pyramid above one that is there: an item is a box of the first of them.
pub static PYRAMID: Pass = Pass {
    name: "pyramid",
    module: "passes/tree/pyramid",
    entry: "build_levels",
    features: &[],
    bindings: &[Binding::write("boxes", "array<LeafBox>"), Binding::params("PyramidParams")],
    makes: &[Makes::Tree],
    twin: twin!(tree::pyramid),
};

/// The nodes of the tree as codes split it, and the roots of its treelets: clear `TREELET_LEVELS` words of `treelets` before.
pub static NODES: Pass = Pass {
    name: "nodes",
    module: "passes/tree/nodes",
    entry: "build_nodes",
    features: &[],
    bindings: &[
        Binding::read("sort_plan", "SortPlan"),
        Binding::read("keys", "array<vec2<u32>>"),
        Binding::read("keys_back", "array<vec2<u32>>"),
        Binding::read("boxes", "array<LeafBox>"),
        Binding::write("nodes", "array<Node>"),
        Binding::write("treelets", "array<atomic<u32>>"),
        Binding::params("BuildParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(tree::nodes),
};

/// Twice as many triangles must still be an i32; above that, `LEAF_BIT` is needed.
const MOST_TRIANGLES: u32 = 1 << 29;

/// Threads of a workgroup of the bounds pass.
const BOUNDS_GROUP: u32 = 256;

/// Builds on the CPU.
fn twin(triangles: &[Triangle], put: &mut PutBuffer<'_>) {
    let tree = cpu::tree::build(triangles);
    put("leaves", bytemuck::cast_slice(&tree.leaves));
    put("nodes", bytemuck::cast_slice(&tree.nodes));
}

fn cost(leaves: &[u8], nodes: &[u8]) -> Result<TreeMeasure, TreeFault> {
    measure(&bytemuck::pod_collect_to_vec::<u8, Triangle>(leaves), &bytemuck::pod_collect_to_vec::<u8, Node>(nodes))
}

fn record_triangles(recording: &mut Recording, triangles: &[Triangle]) {
    record(recording, triangles.len() as u32, morton::core_of(triangles));
}

/// The buffers that building over `n` triangles needs beside `triangles` itself, with their bytes; the sort's too.
pub fn buffers(n: u32) -> Vec<(&'static str, u64)> {
    let bytes = |count: u32, size: usize| u64::from(count) * size as u64;
    let mut all = sort::buffers(n);
    all.extend([
        ("centroid_bounds", bytes(BOUNDS_WORDS, 4)),
        ("leaves", bytes(n, size_of::<Triangle>())),
        ("boxes", bytes(pyramid_boxes(n), size_of::<LeafBox>())),
        ("nodes", bytes(node_count(n), size_of::<Node>())),
        ("treelets", bytes(treelet_words(n), 4)),
    ]);
    all
}

/// Records the whole way from `triangles`, of which there are `n`, to `leaves` and `nodes`. `core` is what
/// [`core_radius`](crate::layout::tree::core_radius) says of them.
pub fn record(recording: &mut Recording, n: u32, core: f32) {
    assert!(n <= MOST_TRIANGLES, "{n} triangles are more than a tree can hold");
    record_codes(recording, n, core);
    record_tree(recording, n);
}

/// Records what comes before the sort: `centroid_bounds`, `keys` and `payload`.
pub fn record_codes(recording: &mut Recording, n: u32, core: f32) {
    let params = BuildParams { count: n, core };
    clear(recording, "centroid_bounds", 0, BOUNDS_WORDS);
    let groups = n.div_ceil(BOUNDS_GROUP * BOUNDS_PER_THREAD);
    recording.run(&BOUNDS, Size::Groups([groups, 1, 1])).params(&params);
    recording.run(&MORTON, Size::Items(u64::from(n))).params(&params);
}

/// Records the sort of `keys` and `payload`, and what comes after it.
pub fn record_tree(recording: &mut Recording, n: u32) {
    let params = BuildParams { count: n, ..BuildParams::default() };
    sort::record(recording, n);
    recording.run(&LEAVES, Size::Items(u64::from(n))).params(&params);
    for (source, count) in levels(n).step_by(PYRAMID_LEVELS as usize) {
        let params = PyramidParams { source, count };
        recording.run(&PYRAMID, Size::Items(u64::from(count / 2))).params(&params);
    }
    clear(recording, "treelets", 0, TREELET_LEVELS);
    recording.run(&NODES, Size::Items(u64::from(node_count(n)))).params(&params);
    treelets::record(recording, n);
}
