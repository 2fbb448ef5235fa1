// The tree as every query reads it. Bindings 0 and 1 are its; a kernel that queries numbers its own from 2.

import package::gen::{Node, Triangle, LEAF_BIT};

// Nodes of four, and triangles of three, times four words: lavapipe reads each member of a struct by a loop of its own over
// its lanes, with a branch for each, and four words by one.
@group(0) @binding(0) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> leaves: array<vec4<u32>>;

fn load_node(index: u32) -> Node {
    let at = 4u * index;
    let x = bitcast<vec4<f32>>(nodes[at]);
    let y = bitcast<vec4<f32>>(nodes[at + 1u]);
    let z = bitcast<vec4<f32>>(nodes[at + 2u]);
    let links = nodes[at + 3u];
    return Node(x, y, z, links.x, links.y, links.z, links.w);
}

fn load_leaf(index: u32) -> Triangle {
    let at = 3u * index;
    let a = leaves[at];
    let b = leaves[at + 1u];
    let c = leaves[at + 2u];
    return Triangle(bitcast<vec3<f32>>(a.xyz), a.w, bitcast<vec3<f32>>(b.xyz), b.w, bitcast<vec3<f32>>(c.xyz), c.w);
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
