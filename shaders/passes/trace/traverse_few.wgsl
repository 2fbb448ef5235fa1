// Traversal where there are at most 32 triangles: first the boxes of all leaves, then the triangles of those boxes that the ray meets.
//
// All rays read the same leaves in the same order, so that on a GPU none waits for another, and there is no stack. A walk down so small
// a tree reads about as much, each ray in an order of its own.

import package::gen::{Hit, Ray, NO_HIT};
import package::lib::intersect::{Query, prepare_query, slab_interval};
import package::passes::trace::children::{interval_passes};
import package::passes::trace::few_boxes::{count_leaves, kept_box};
import package::passes::trace::leaf::{test_leaf_in};

// The bit of a leaf if the ray meets its box, else 0.
fn bit_if_met(query: Query, leaf: u32) -> u32 {
    let own = kept_box(leaf);
    let at = slab_interval(query, own.low, own.high);
    return select(0u, 1u << leaf, interval_passes(at.x, at.y, query.t_min, query.t_max));
}

// As package::passes::trace::traverse::traverse, but that it visits no nodes; `root` is one. Its kernel has kept the boxes
// (package::passes::trace::few_boxes).
fn traverse_few(ray: Ray, root: u32, extent: f32, enough: f32, chance: u32) -> Hit {
    let query = prepare_query(ray, extent, chance);
    var hit = Hit(query.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    // A ray that leads nowhere meets nothing.
    if all(ray.direction == vec3(0.0)) {
        return hit;
    }
    let last = count_leaves(root) - 1u;
    // Four a round, so that one waits less for its box; the last one again for those that are left over.
    var met = 0u;
    for (var leaf = 0u; leaf <= last; leaf += 4u) {
        met |= bit_if_met(query, leaf) | bit_if_met(query, min(leaf + 1u, last));
        met |= bit_if_met(query, min(leaf + 2u, last)) | bit_if_met(query, min(leaf + 3u, last));
    }
    while met != 0u && hit.t >= enough {
        let leaf = firstTrailingBit(met);
        test_leaf_in(query, leaf, kept_box(leaf), &hit);
        met &= met - 1u;
    }
    return hit;
}
