//! Whether a tree is one, how deep it is, and what it costs.

use thiserror::Error;

use super::bounds::Bounds;
use super::node_boxes::child_boxes;
use crate::layout::tree::{LEAF_BIT, NO_ROOT, Node, Triangle, root};

/// What is wrong with a tree.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TreeFault {
    #[error("{leaves} leaves need {} nodes, not {nodes}", leaves.saturating_sub(1))]
    NodeCount { leaves: usize, nodes: usize },
    #[error("node {node} has the child {child:#x}, which does not exist")]
    NoSuchChild { node: u32, child: u32 },
    #[error("{child:#x} is a child of node {node} and of another one")]
    TwoParents { node: u32, child: u32 },
    #[error("{missing} nodes and leaves are not below the root")]
    Unreachable { missing: usize },
    #[error("node {node} says its parent is {says:#x}, but it is {is:#x}")]
    Parent { node: u32, says: u32, is: u32 },
    #[error("node {node} says it has {says} leaves, but it has {is}")]
    LeafCount { node: u32, says: u32, is: u32 },
    #[error("node {node} gives its child {child:#x} the box {says:?}, but what is below it has {is:?}")]
    Box { node: u32, child: u32, says: Bounds, is: Bounds },
    #[error("leaf {leaf} is not a triangle of the scene, or one that another leaf holds too")]
    Leaf { leaf: u32 },
}

/// What a sound tree is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeMeasure {
    /// Steps from the root to the deepest leaf; 0 without any node.
    pub depth: u32,
    /// Cost of a ray by the surface area heuristic: the areas of all nodes' and all leaves' boxes over the area of the
    /// root's, each visit of a node and each test of a triangle counting 1. Where the root's area is 0, each ratio counts
    /// as 1.
    pub sah: f64,
}

/// What lies below a child.
#[derive(Clone, Copy)]
struct Below {
    bounds: Bounds,
    leaves: u32,
}

/// Checks a tree entirely: each leaf and each node is below the root exactly once, parents' words, numbers of leaves,
/// and that each child's box equals what its triangles' padded boxes span.
pub fn measure(leaves: &[Triangle], nodes: &[Node]) -> Result<TreeMeasure, TreeFault> {
    if nodes.len() != leaves.len().saturating_sub(1) {
        return Err(TreeFault::NodeCount { leaves: leaves.len(), nodes: nodes.len() });
    }
    check_permutation(leaves)?;
    let leaf = |index: u32| Below { bounds: Bounds::padded(&leaves[index as usize]), leaves: 1 };
    if nodes.is_empty() {
        return Ok(TreeMeasure { depth: 0, sah: leaves.len() as f64 });
    }
    let (downwards, depth) = walk(leaves.len(), nodes)?;
    let mut below = vec![leaf(0); nodes.len()];
    let mut areas = leaves.iter().map(|triangle| Bounds::padded(triangle).half_area()).sum::<f64>();
    for &index in downwards.iter().rev() {
        let node = &nodes[index as usize];
        let [left, right] = [node.left, node.right].map(|child| match child & LEAF_BIT {
            0 => below[child as usize],
            _ => leaf(child & !LEAF_BIT),
        });
        let joined = check_node(index, node, left, right)?;
        areas += joined.bounds.half_area();
        below[index as usize] = joined;
    }
    let whole = below[0].bounds.half_area();
    let sah = if whole > 0.0 { areas / whole } else { (leaves.len() + nodes.len()) as f64 };
    Ok(TreeMeasure { depth, sah })
}

/// Every triangle of the scene is in one leaf.
fn check_permutation(leaves: &[Triangle]) -> Result<(), TreeFault> {
    let mut seen = vec![false; leaves.len()];
    for (leaf, triangle) in leaves.iter().enumerate() {
        match seen.get_mut(triangle.index as usize) {
            Some(seen) if !*seen => *seen = true,
            _ => return Err(TreeFault::Leaf { leaf: leaf as u32 }),
        }
    }
    Ok(())
}

/// All nodes, parents before children, and the depth.
fn walk(leaves: usize, nodes: &[Node]) -> Result<(Vec<u32>, u32), TreeFault> {
    let mut leaf_seen = vec![false; leaves];
    let mut node_seen = vec![false; nodes.len()];
    node_seen[0] = true;
    let mut downwards = Vec::with_capacity(nodes.len());
    let mut deepest = 0;
    let mut open = vec![(root(leaves as u32), NO_ROOT, 0)];
    while let Some((index, parent, depth)) = open.pop() {
        let node = &nodes[index as usize];
        if node.parent != parent {
            return Err(TreeFault::Parent { node: index, says: node.parent, is: parent });
        }
        downwards.push(index);
        deepest = deepest.max(depth + 1);
        for child in [node.left, node.right] {
            let is_leaf = child & LEAF_BIT != 0;
            let seen = if is_leaf { &mut leaf_seen } else { &mut node_seen };
            match seen.get_mut((child & !LEAF_BIT) as usize) {
                None => return Err(TreeFault::NoSuchChild { node: index, child }),
                Some(true) => return Err(TreeFault::TwoParents { node: index, child }),
                Some(seen) => *seen = true,
            }
            if !is_leaf {
                open.push((child, index, depth + 1));
            }
        }
    }
    let missing = leaf_seen.iter().chain(&node_seen).filter(|seen| !**seen).count();
    if missing > 0 { Err(TreeFault::Unreachable { missing }) } else { Ok((downwards, deepest)) }
}

/// What lies below a node, if all that it says of itself is true.
fn check_node(index: u32, node: &Node, left: Below, right: Below) -> Result<Below, TreeFault> {
    let is = left.leaves + right.leaves;
    if node.leaves != is {
        return Err(TreeFault::LeafCount { node: index, says: node.leaves, is });
    }
    let [left_box, right_box] = child_boxes(node);
    for (child, says, is) in [(node.left, left_box, left.bounds), (node.right, right_box, right.bounds)] {
        if says != is {
            return Err(TreeFault::Box { node: index, child, says, is });
        }
    }
    Ok(Below { bounds: left.bounds.joined(right.bounds), leaves: is })
}
