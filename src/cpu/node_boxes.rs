//! The boxes of its children that a node holds.

use glam::Vec4;

use super::bounds::Bounds;
use crate::layout::tree::Node;

/// Gives a node the boxes of its children.
pub fn set_boxes(node: &mut Node, left: Bounds, right: Bounds) {
    let along = |axis: usize| Vec4::new(left.low[axis], left.high[axis], right.low[axis], right.high[axis]);
    (node.x, node.y, node.z) = (along(0), along(1), along(2));
}

/// The boxes of a node's children, left and right.
pub fn child_boxes(node: &Node) -> [Bounds; 2] {
    let corner = |i: usize| glam::Vec3::new(node.x[i], node.y[i], node.z[i]);
    [Bounds { low: corner(0), high: corner(1) }, Bounds { low: corner(2), high: corner(3) }]
}
