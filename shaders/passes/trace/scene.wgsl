// The tree as every query reads it. Bindings 0 and 1 are its; a kernel that queries numbers its own from 2.

import package::gen::{Node, Triangle, LEAF_BIT};

@group(0) @binding(0) var<storage, read> nodes: array<Node>;
@group(0) @binding(1) var<storage, read> leaves: array<Triangle>;

// The greatest coordinate of the scene's box; there is at least one triangle.
fn scene_extent(root: u32) -> f32 {
    if root >= LEAF_BIT {
        let leaf = leaves[root & ~LEAF_BIT];
        let m = max(max(abs(leaf.a), abs(leaf.b)), abs(leaf.c));
        return max(max(m.x, m.y), m.z);
    }
    let m = max(max(abs(nodes[root].x), abs(nodes[root].y)), abs(nodes[root].z));
    return max(max(m.x, m.y), max(m.z, m.w));
}
