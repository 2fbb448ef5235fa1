// The tree traversed by one ray: the closest hit, or whether there is any.
//
// The hit is the least (t, triangle), whatever the tree. A hit's t is clamped into the slabs of the triangle's own box,
// slabs are monotone, and a box is left out only if it begins beyond the best t or ends before t_min: so the box of
// every ancestor of the winner passes, however its numbers are rounded.
//
// The order of the traversal is a function of the ray alone (near child first, the left one of two equally near). A stack of
// STACK_SIZE entries remembers the far children; when it is full, the oldest is forgotten. Once the stack is empty and
// something was forgotten, the traversal climbs from the node visited last and goes on in the first far child it has not
// come from. What was passed by before stays passed by, since the best t only shrinks.
//
// Paths among few triangles take package::passes::trace::traverse_few instead, for the same hits.

import package::gen::{Hit, Ray, NO_CHANCE, NO_HIT, NO_ROOT};
import package::lib::intersect::{prepare_query};
import package::passes::trace::scene::{scene_extent};
@if(!software) import package::passes::trace::traverse_divergent::{traverse_nodes};
@if(software) import package::passes::trace::traverse_masked::{traverse_nodes};

// The hit of least (t, triangle), or some hit that is nearer than `enough`: traversal ends at its first such. `extent` is that of
// scene_extent(); `chance` is the ray's own number, by which surfaces with holes are there or not. Leaves are tested as soon as their
// parent is visited, nearer first, and only nodes wait on the stack.
fn traverse(ray: Ray, root: u32, extent: f32, enough: f32, chance: u32) -> Hit {
    // A ray that leads nowhere has nowhere to begin.
    let begin = select(root, NO_ROOT, all(ray.direction == vec3(0.0)));
    return traverse_nodes(prepare_query(ray, extent, chance), begin, enough);
}

// The hit of least (t, triangle).
fn closest_hit(ray: Ray, root: u32) -> Hit {
    return traverse(ray, root, scene_extent(root), 0.0, NO_CHANCE);
}

// Whether anything lies between the ray's ends.
fn any_hit(ray: Ray, root: u32) -> bool {
    return traverse(ray, root, scene_extent(root), ray.t_max, NO_CHANCE).triangle != NO_HIT;
}
