//! Subtrees joined anew by area, where codes had split them: from the nodes of an LBVH to those of a tree that rays walk in fewer visits.
//!
//! A treelet is joined by one workgroup in its own memory, so nothing has to order workgroups, and it keeps the numbers of its nodes, so treelets don't
//! know of each other. Each level is a dispatch: of treelets that are joined of leaves, then of larger ones of the clusters below.

use crate::layout::tree::{TreeletParams, treelet_levels};
use crate::passes::twin::twin;
use crate::passes::{Binding, Makes, Pass, Recording, Size};

/// Treelets of up to `TREELET_SIZE` leaves.
pub static TREELETS: Pass = Pass {
    name: "treelets",
    module: "passes/tree/treelets",
    entry: "build_treelets",
    features: &[],
    bindings: &[
        Binding::read("treelets", "array<u32>"),
        Binding::read("boxes", "array<LeafBox>"),
        Binding::write("nodes", "array<Node>"),
        Binding::params("TreeletParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(treelets::treelets),
};

/// Larger treelets, of the clusters below.
pub static TOPS: Pass = Pass {
    name: "treelet tops",
    module: "passes/tree/treelet_tops",
    entry: "build_treelet_tops",
    features: &[],
    bindings: &[
        Binding::read("treelets", "array<u32>"),
        Binding::write("nodes", "array<Node>"),
        Binding::params("TreeletParams"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(treelets::treelets),
};

/// More workgroups are no faster; each takes the next treelet once it is done with one.
const MOST_GROUPS: u32 = 32_768;

/// Records all levels of a tree over `n` triangles, whose `nodes` and lists of roots are there.
pub fn record(recording: &mut Recording, n: u32) {
    for (level, at) in (0..).zip(treelet_levels(n)) {
        let params = TreeletParams { level, first: at.first, below: at.below, pad: 0 };
        let pass = if level == 0 { &TREELETS } else { &TOPS };
        // Some more than there are, if they have two thirds of the leaves that they may have.
        let groups = n.div_ceil(at.limit / 2).min(MOST_GROUPS);
        recording.run(pass, Size::Groups([groups, 1, 1])).params(&params);
    }
}
