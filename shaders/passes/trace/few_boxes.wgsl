// The padded boxes of all leaves where there are at most FEW_TRIANGLES, in workgroup memory: made once a workgroup, not once a ray.
//
// A kernel that traces rays by package::passes::trace::traverse_few calls keep_boxes first, with all its invocations.

import package::gen::{FEW_TRIANGLES};
import package::lib::intersect::{PaddedBox, padded_box};
import package::passes::trace::scene::{load_leaf, load_node};

var<workgroup> lows: array<vec3<f32>, FEW_TRIANGLES>;
var<workgroup> highs: array<vec3<f32>, FEW_TRIANGLES>;

// How many leaves there are; `root` is a node.
fn count_leaves(root: u32) -> u32 {
    return clamp(load_node(root).leaves, 1u, FEW_TRIANGLES);
}

// Fills the boxes: `lane` is the invocation's number in a workgroup of `lanes`.
fn keep_boxes(root: u32, lane: u32, lanes: u32) {
    for (var leaf = lane; leaf < count_leaves(root); leaf += lanes) {
        let triangle = load_leaf(leaf);
        let own = padded_box(triangle.a, triangle.b, triangle.c);
        lows[leaf] = own.low;
        highs[leaf] = own.high;
    }
    workgroupBarrier();
}

// The padded_box() of a leaf's triangle.
fn kept_box(leaf: u32) -> PaddedBox {
    return PaddedBox(lows[leaf], highs[leaf]);
}
