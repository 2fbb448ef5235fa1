// The tree as every query reads it. Bindings 0 and 1 are its; a kernel that queries numbers its own from 2.

import package::gen::{Node, Triangle, LEAF_BIT, NODE_STRIDE, TRIANGLE_STRIDE, unpack_node, unpack_triangle};

// By vectors of four words: lavapipe reads each member of a struct by a loop of its own over its lanes, with a branch for each, and four
// words by one.
@group(0) @binding(0) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> leaves: array<vec4<u32>>;

fn load_node(index: u32) -> Node {
    let at = NODE_STRIDE * index;
    return unpack_node(nodes[at], nodes[at + 1u], nodes[at + 2u], nodes[at + 3u]);
}

fn load_leaf(index: u32) -> Triangle {
    let at = TRIANGLE_STRIDE * index;
    return unpack_triangle(leaves[at], leaves[at + 1u], leaves[at + 2u]);
}

// The greatest coordinate of the scene's box; there is at least one triangle.
fn scene_extent(root: u32) -> f32 {
    if root >= LEAF_BIT {
        let leaf = load_leaf(root & ~LEAF_BIT);
        let m = max(max(abs(leaf.a), abs(leaf.b)), abs(leaf.c));
        return max(max(m.x, m.y), m.z);
    }
    let node = load_node(root);
    let m = max(max(abs(node.x), abs(node.y)), abs(node.z));
    return max(max(m.x, m.y), max(m.z, m.w));
}
