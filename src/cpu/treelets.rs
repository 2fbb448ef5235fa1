//! Twin of `treelets` and `treelet tops`: a tree that was split by codes, joined anew by area.
//!
//! Subtrees of up to [`TREELET_SIZE`] leaves are taken apart and joined from below by parallel locally-ordered clustering (Meister and
//! Bittner 2018): of clusters in the order of their codes, each looks at those up to [`TREELET_RADIUS`] places away, and two that
//! are nearest to each other become one. Then larger subtrees are, of clusters that are as many times larger, up to the whole tree; each reaches
//! across the borders of those before it. A subtree keeps the numbers of its nodes, and its root's is the same: so what is above it stays right.

use glam::Vec3;

use super::bounds::Bounds;
use super::node_boxes::{child_boxes, set_boxes};
use crate::layout::tree::{
    LEAF_BIT, NO_ROOT, Node, TREELET_LEAST_AREA, TREELET_LONGEST, TREELET_RADIUS, TREELET_SIZE, TREELET_TURNS,
    TreeletLevel, treelet_levels,
};
use crate::parallel;

/// How far a cluster looks for the nearest.
const RADIUS: usize = TREELET_RADIUS as usize;

/// A subtree that is one thing, while others are joined to it.
#[derive(Clone, Copy)]
struct Cluster {
    /// Its root: a node, or `LEAF_BIT` and a leaf.
    child: u32,
    /// Leaves below it.
    leaves: u32,
    bounds: Bounds,
}

/// What a treelet is taken apart to.
struct Parts {
    /// In the order of their codes.
    clusters: Vec<Cluster>,
    /// The numbers of the nodes above them, that of the root first.
    numbers: Vec<u32>,
}

/// Joins all treelets of a tree over so many leaves anew.
pub fn treelets(nodes: &mut [Node]) {
    for level in treelet_levels(nodes.len() as u32 + 1) {
        let roots = roots(nodes, &level);
        let made = parallel::map(roots.len(), |i| {
            let parts = take_apart(nodes, roots[i], level.below);
            parts.map(joined).unwrap_or_default()
        });
        for (number, node) in made.into_iter().flatten() {
            let parent = nodes[number as usize].parent;
            nodes[number as usize] = Node { parent, ..node };
            for child in [node.left, node.right].into_iter().filter(|child| child & LEAF_BIT == 0) {
                nodes[child as usize].parent = number;
            }
        }
    }
}

/// The roots of a level: the largest subtrees that are not too large, but for those that were one treelet before.
fn roots(nodes: &[Node], level: &TreeletLevel) -> Vec<u32> {
    let is_root = |node: &Node| {
        let is_largest = node.parent == NO_ROOT || nodes[node.parent as usize].leaves > level.limit;
        is_largest && node.leaves > level.before && node.leaves <= level.limit
    };
    (0..nodes.len() as u32).filter(|index| is_root(&nodes[*index as usize])).collect()
}

/// The clusters of at most `below` leaves below a root; none where there are too many.
fn take_apart(nodes: &[Node], root: u32, below: u32) -> Option<Parts> {
    let whole = Cluster { child: root, leaves: nodes[root as usize].leaves, bounds: Bounds::EMPTY };
    let (mut clusters, mut numbers) = (vec![whole], Vec::new());
    while clusters.iter().any(|cluster| cluster.leaves > below) {
        let mut next = Vec::with_capacity(2 * clusters.len());
        for cluster in clusters {
            if cluster.leaves <= below {
                next.push(cluster);
                continue;
            }
            numbers.push(cluster.child);
            let node = &nodes[cluster.child as usize];
            for (child, bounds) in [node.left, node.right].into_iter().zip(child_boxes(node)) {
                let leaves = if child & LEAF_BIT != 0 { 1 } else { nodes[child as usize].leaves };
                next.push(Cluster { child, leaves, bounds });
            }
        }
        if next.len() > TREELET_SIZE as usize {
            return None;
        }
        clusters = next;
    }
    if below == 1 {
        // The nodes over a range of leaves are numbered from its first leaf or up to its last, and the root's number is that one.
        numbers.sort_unstable_by_key(|number| number.abs_diff(root));
    }
    Some(Parts { clusters, numbers })
}

/// Clusters joined until there is one: nodes with their numbers, those below before those above.
fn joined(parts: Parts) -> Vec<(u32, Node)> {
    let Parts { mut clusters, mut numbers } = parts;
    let mut made = Vec::with_capacity(numbers.len());
    for turn in 0.. {
        if clusters.len() < 2 {
            break;
        }
        let nearest = if turn < TREELET_TURNS { nearest(&clusters) } else { neighbours(clusters.len()) };
        let mut next = Vec::with_capacity(clusters.len());
        for (place, &cluster) in clusters.iter().enumerate() {
            let other = nearest[place];
            if nearest[other] != place || other == place {
                next.push(cluster);
            } else if place < other {
                let number = numbers.pop().expect("invariant: as many nodes as were taken apart");
                let (node, cluster) = pair(cluster, clusters[other], number);
                made.push((number, node));
                next.push(cluster);
            }
        }
        clusters = next;
    }
    made
}

/// For each of so many places the other of its pair; for a last one without, itself.
fn neighbours(count: usize) -> Vec<usize> {
    (0..count).map(|place| (place ^ 1).min(count - 1)).collect()
}

/// For each cluster the place of that which it is nearest to: where the box of both has least surface beyond those of either. (By the surface of
/// both boxes' box alone, as in the paper, costs are 0.5 % higher, and shells around shells are all as near.) Of two as good ones, the
/// pair whose places differ in lower bits, then the first: so all clusters order pairs in one way, and the best of all pairs is nearest to each other.
fn nearest(clusters: &[Cluster]) -> Vec<usize> {
    let areas: Vec<f32> = clusters.iter().map(|cluster| cluster_area(cluster.bounds)).collect();
    let growth = |a: usize, b: usize| {
        let both = cluster_area(clusters[a].bounds.joined(clusters[b].bounds));
        (both - areas[a]) + (both - areas[b])
    };
    let ahead = |place: usize| {
        let behind = |i: usize| place + 1 + i;
        std::array::from_fn(|i| if behind(i) < clusters.len() { growth(place, behind(i)) } else { f32::MAX })
    };
    let ahead: Vec<[f32; RADIUS]> = (0..clusters.len()).map(ahead).collect();
    let key = |place: usize, other: usize| {
        let (first, second) = (place.min(other), place.max(other));
        (ahead[first][second - first - 1].to_bits(), place ^ other, first)
    };
    let of = |place: usize| {
        let others = place.saturating_sub(RADIUS)..(place + RADIUS + 1).min(clusters.len());
        let others = others.filter(|other| *other != place);
        others.min_by_key(|other| key(place, *other)).expect("invariant: there are two")
    };
    (0..clusters.len()).map(of).collect()
}

/// Half of a box's surface, as kernels compute it.
pub fn cluster_area(bounds: Bounds) -> f32 {
    let size = (bounds.high - bounds.low).min(Vec3::splat(TREELET_LONGEST));
    let product = |a: f32, b: f32| if a * b < TREELET_LEAST_AREA { 0.0 } else { a * b };
    product(size.x, size.y) + product(size.y, size.z) + product(size.z, size.x)
}

/// A node of two clusters, and the cluster that it is.
fn pair(left: Cluster, right: Cluster, number: u32) -> (Node, Cluster) {
    let leaves = left.leaves + right.leaves;
    let mut node = Node { left: left.child, right: right.child, leaves, ..Node::default() };
    set_boxes(&mut node, left.bounds, right.bounds);
    (node, Cluster { child: number, leaves, bounds: left.bounds.joined(right.bounds) })
}
