//! Twins of `leaves`, `pyramid` and `nodes`.
//!
//! The tree is the same as the GPU's, found another way: ranges are split from the root down and boxes are joined from
//! the leaves up, where the GPU searches each node's range by itself and queries the pyramid.

use super::bounds::Bounds;
use super::morton;
use super::node_boxes::set_boxes;
use super::treelets::treelets;
use crate::layout::tree::{LEAF_BIT, LeafBox, NO_ROOT, Node, Triangle, node_count};

/// A tree, and the triangles of its leaves in leaf order.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    pub leaves: Vec<Triangle>,
    pub nodes: Vec<Node>,
}

/// Builds the tree over triangles in scene order, as all the passes together do.
pub fn build(triangles: &[Triangle]) -> Tree {
    let mut tree = by_codes(triangles);
    treelets(&mut tree.nodes);
    tree
}

/// The same as codes split it, before treelets are joined anew.
pub fn by_codes(triangles: &[Triangle]) -> Tree {
    let codes = morton::codes(triangles, morton::bounds(triangles).centroids, morton::core_of(triangles));
    let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
    order.sort_by_key(|&triangle| codes[triangle as usize]);
    let sorted: Vec<u64> = order.iter().map(|&triangle| codes[triangle as usize]).collect();
    let leaves = leaves(triangles, &order);
    Tree { nodes: nodes(&sorted, &leaves), leaves }
}

/// Triangles in the given order.
pub fn leaves(triangles: &[Triangle], order: &[u32]) -> Vec<Triangle> {
    order.iter().map(|&triangle| triangles[triangle as usize]).collect()
}

/// The pyramid over triangles in leaf order, level behind level; level k has floor(n / 2^k) boxes.
pub fn pyramid(leaves: &[Triangle]) -> Vec<LeafBox> {
    let mut level: Vec<Bounds> = leaves.iter().map(Bounds::padded).collect();
    let mut all = level.clone();
    while level.len() > 1 {
        level = level.chunks_exact(2).map(|pair| pair[0].joined(pair[1])).collect();
        all.extend(&level);
    }
    all.into_iter().map(|b| LeafBox { low: b.low.extend(0.0), high: b.high.extend(0.0) }).collect()
}

/// The nodes over sorted codes and the triangles in their order, as they are before treelets are joined anew.
pub fn nodes(codes: &[u64], leaves: &[Triangle]) -> Vec<Node> {
    let mut nodes = vec![Node::default(); node_count(leaves.len() as u32) as usize];
    if nodes.is_empty() {
        return nodes;
    }
    let mut downwards = Vec::with_capacity(nodes.len());
    let mut open = vec![(0, 0, leaves.len() - 1, NO_ROOT)];
    while let Some((node, first, last, parent)) = open.pop() {
        downwards.push(node);
        let split = split_of(codes, first, last);
        let mut child = |at: usize, from: usize, to: usize| {
            if from == to {
                return LEAF_BIT | at as u32;
            }
            open.push((at, from, to, node as u32));
            at as u32
        };
        let (left, right) = (child(split, first, split), child(split + 1, split + 1, last));
        nodes[node] = Node { left, right, leaves: (last - first + 1) as u32, parent, ..Node::default() };
    }
    let mut boxes = vec![Bounds::EMPTY; nodes.len()];
    for &node in downwards.iter().rev() {
        let [left, right] = [nodes[node].left, nodes[node].right].map(|child| match child & LEAF_BIT {
            0 => boxes[child as usize],
            _ => Bounds::padded(&leaves[(child & !LEAF_BIT) as usize]),
        });
        boxes[node] = left.joined(right);
        set_boxes(&mut nodes[node], left, right);
    }
    nodes
}

/// The last leaf of a range's left part: the parts differ in the highest bit in which any two of the range's leaves do,
/// first of their codes, then of their indices.
fn split_of(codes: &[u64], first: usize, last: usize) -> usize {
    let (low, high) = (codes[first], codes[last]);
    if low == high {
        let bit = (first ^ last).ilog2();
        return (last >> bit << bit) - 1;
    }
    let bit = (low ^ high).ilog2();
    first + codes[first..=last].partition_point(|code| code >> bit & 1 == 0) - 1
}
