// A ray against the triangle of one leaf.

import package::gen::{Hit, Triangle};
import package::lib::intersect::{PaddedBox, Query, intersect_triangle, padded_box};
@if(cutout) import package::passes::trace::cutout::{is_there};
import package::passes::trace::scene::{load_leaf};

// Makes the triangle of a leaf the hit if it comes before the hit so far: if it is nearer, or as near and of lower index.
fn test_leaf(query: Query, leaf: u32, hit: ptr<function, Hit>) {
    let triangle = load_leaf(leaf);
    test_triangle(query, leaf, triangle, padded_box(triangle.a, triangle.b, triangle.c), hit);
}

// The same where the triangle's own padded box is known.
fn test_leaf_in(query: Query, leaf: u32, own: PaddedBox, hit: ptr<function, Hit>) {
    test_triangle(query, leaf, load_leaf(leaf), own, hit);
}

fn test_triangle(query: Query, leaf: u32, triangle: Triangle, own: PaddedBox, hit: ptr<function, Hit>) {
    let found = intersect_triangle(query, triangle.a, triangle.b, triangle.c, own);
    if !found.hit || found.t <= query.t_min {
        return;
    }
    var nearer = found.t < (*hit).t || (found.t == (*hit).t && triangle.index < (*hit).triangle);
    @if(cutout) {
        if nearer {
            nearer = is_there(triangle, found.b1, found.b2, query.chance);
        }
    }
    if nearer {
        (*hit).t = found.t;
        (*hit).triangle = triangle.index;
        (*hit).leaf = leaf;
        (*hit).b1 = found.b1;
        (*hit).b2 = found.b2;
    }
}
