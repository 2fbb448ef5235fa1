// The tree walked by one ray: the closest hit, or whether there is any.
//
// The hit is the least (t, triangle), whatever the tree. A hit's t is clamped into the slabs of the triangle's own box,
// slabs are monotone, and a box is left out only if it begins beyond the best t or ends before t_min: so the box of
// every ancestor of the winner passes, however its numbers are rounded.
//
// The order of the walk is a function of the ray alone (near child first, the left one of two equally near). A stack of
// STACK_SIZE entries remembers the far children; when it is full, the oldest is forgotten. Once the stack is empty and
// something was forgotten, the walk climbs from the node visited last and goes on in the first far child it has not
// come from. What was passed by before stays passed by, since the best t only shrinks.

import package::gen::{Hit, Node, Ray, LEAF_BIT, MAX_STEPS, NO_HIT, NO_ROOT};
import package::lib::intersect::{Query, prepare_query, FAR_GROWTH};
import package::lib::traverse_config::{STACK_SIZE, VISITS_PER_LEAF};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node, scene_extent};

// Where the ray enters and leaves the boxes of a node's two children.
struct ChildIntervals {
    near_left: f32,
    far_left: f32,
    near_right: f32,
    far_right: f32,
}

// slab_interval() of both children.
fn child_intervals(query: Query, node: Node) -> ChildIntervals {
    let x = fma(node.x, vec4(query.inverse.x), vec4(query.low.x, query.high.x, query.low.x, query.high.x));
    let y = fma(node.y, vec4(query.inverse.y), vec4(query.low.y, query.high.y, query.low.y, query.high.y));
    let z = fma(node.z, vec4(query.inverse.z), vec4(query.low.z, query.high.z, query.low.z, query.high.z));
    return ChildIntervals(
        max(max(min(x.x, x.y), min(y.x, y.y)), min(z.x, z.y)),
        min(min(max(x.x, x.y), max(y.x, y.y)), max(z.x, z.y)) * FAR_GROWTH,
        max(max(min(x.z, x.w), min(y.z, y.w)), min(z.z, z.w)),
        min(min(max(x.z, x.w), max(y.z, y.w)), max(z.z, z.w)) * FAR_GROWTH,
    );
}

fn interval_passes(near: f32, far: f32, t_min: f32, t: f32) -> bool {
    return near <= min(far, t) && far >= t_min;
}

// Where a walk is.
struct Walk {
    // The node to look at next, or NO_ROOT: then one of the stack, or the way up.
    next: u32,
    // The node looked at last, and the one above it.
    last: u32,
    parent: u32,
    // Leaves to test, nearer first.
    first_leaf: u32,
    second_leaf: u32,
    // A node for the stack.
    later: u32,
}

// A look at the children of a node: what to enter, what to test. Where the walk climbs, `below` is the child it comes from; what
// was near is done then, and of what is far a leaf. Else `below` is NO_ROOT.
fn look_at(query: Query, index: u32, below: u32, t: f32) -> Walk {
    let node = load_node(index);
    let at = child_intervals(query, node);
    let left_first = at.near_left <= at.near_right;
    let left_passes = interval_passes(at.near_left, at.far_left, query.t_min, t);
    let right_passes = interval_passes(at.near_right, at.far_right, query.t_min, t);
    let near_child = select(node.right, node.left, left_first);
    let far_child = select(node.left, node.right, left_first);
    let climbs = below != NO_ROOT;
    let far_is_done = climbs && (below != near_child || far_child >= LEAF_BIT);
    let near_passes = select(right_passes, left_passes, left_first) && !climbs;
    let far_passes = select(left_passes, right_passes, left_first) && !far_is_done;
    let enter_near = near_passes && near_child < LEAF_BIT;
    let enter_far = far_passes && far_child < LEAF_BIT;
    let test_near = near_passes && near_child >= LEAF_BIT;
    let test_far = far_passes && far_child >= LEAF_BIT;
    return Walk(
        select(select(NO_ROOT, far_child, enter_far), near_child, enter_near),
        index,
        node.parent,
        select(select(NO_ROOT, far_child, test_far), near_child, test_near),
        select(NO_ROOT, far_child, test_near && test_far),
        select(NO_ROOT, far_child, enter_near && enter_far),
    );
}

// The hit of least (t, triangle), or, where `any`, some hit: the walk ends at its first. Triangle `except` is passed through.
// `extent` is that of scene_extent(). Leaves are tested as soon as their parent is visited, nearer first, and only nodes
// wait on the stack.
//
// Both loops are left at their ends, and a step up is a round like any other: lavapipe runs a body to its end for the lanes
// that left in its middle, and what stands under an `if`, or in a loop there, even for none.
fn traverse(ray: Ray, root: u32, extent: f32, any: bool, except: u32) -> Hit {
    var hit = Hit(ray.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    let query = prepare_query(ray, extent);
    var stack: array<u32, STACK_SIZE>;
    // Entries pushed and not popped, and how many of them, from the oldest, were forgotten.
    var top = 0u;
    var bottom = 0u;
    var walking = root != NO_ROOT && !all(ray.direction == vec3(0.0));
    var walk = Walk(root, NO_ROOT, NO_ROOT, NO_ROOT, NO_ROOT, NO_ROOT);
    if walking && root >= LEAF_BIT {
        walk.first_leaf = root;
        walk.next = NO_ROOT;
    }
    loop {
        var visits = 0u;
        loop {
            visits += 1u;
            if walking && walk.first_leaf == NO_ROOT {
                var below = NO_ROOT;
                if walk.next == NO_ROOT {
                    if top != bottom {
                        top -= 1u;
                        walk.next = stack[top % STACK_SIZE];
                    } else if bottom != 0u {
                        below = walk.last;
                        walk.next = walk.parent;
                    }
                }
                walking = walk.next != NO_ROOT && hit.steps < MAX_STEPS;
                if walking {
                    hit.steps += 1u;
                    walk = look_at(query, walk.next, below, hit.t);
                    if walk.later != NO_ROOT {
                        stack[top % STACK_SIZE] = walk.later;
                        top += 1u;
                        bottom = max(bottom, max(top, STACK_SIZE) - STACK_SIZE);
                    }
                }
            }
            continuing {
                break if visits == VISITS_PER_LEAF || !walking || walk.first_leaf != NO_ROOT;
            }
        }
        if walk.first_leaf != NO_ROOT {
            test_leaf(query, walk.first_leaf & ~LEAF_BIT, except, &hit);
            walk.first_leaf = walk.second_leaf;
            walk.second_leaf = NO_ROOT;
            walking = !(any && hit.triangle != NO_HIT);
        }
        continuing {
            break if !walking;
        }
    }
    return hit;
}

// The hit of least (t, triangle).
fn closest_hit(ray: Ray, root: u32) -> Hit {
    return traverse(ray, root, scene_extent(root), false, NO_HIT);
}

// Whether anything lies between the ray's ends.
fn any_hit(ray: Ray, root: u32) -> bool {
    return traverse(ray, root, scene_extent(root), true, NO_HIT).triangle != NO_HIT;
}
