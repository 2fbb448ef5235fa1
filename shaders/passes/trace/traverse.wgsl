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
import package::passes::trace::scene::{nodes, scene_extent};

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

// The next node of the walk after everything below `last`, or NO_ROOT.
fn climb(query: Query, last: u32, hit: ptr<function, Hit>) -> u32 {
    var child = last;
    while (*hit).steps < MAX_STEPS {
        let parent = nodes[child].parent;
        if parent == NO_ROOT {
            break;
        }
        (*hit).steps += 1u;
        let node = nodes[parent];
        let at = child_intervals(query, node);
        let from_left = node.left == child;
        if from_left == (at.near_left <= at.near_right) {
            let other = select(node.left, node.right, from_left);
            let near = select(at.near_left, at.near_right, from_left);
            let far = select(at.far_left, at.far_right, from_left);
            if other < LEAF_BIT && interval_passes(near, far, query.t_min, (*hit).t) {
                return other;
            }
        }
        child = parent;
    }
    return NO_ROOT;
}

// What is to do after a look at a node's children; NO_ROOT where there is nothing.
struct Visit {
    // The node to visit next.
    next: u32,
    // The farther node, if both children are to be visited.
    later: u32,
    // Leaves to test, nearer first.
    first_leaf: u32,
    second_leaf: u32,
}

fn visit_node(query: Query, index: u32, t: f32) -> Visit {
    let node = nodes[index];
    let at = child_intervals(query, node);
    let left_first = at.near_left <= at.near_right;
    let left_passes = interval_passes(at.near_left, at.far_left, query.t_min, t);
    let right_passes = interval_passes(at.near_right, at.far_right, query.t_min, t);
    let near_passes = select(right_passes, left_passes, left_first);
    let far_passes = select(left_passes, right_passes, left_first);
    let near_child = select(node.right, node.left, left_first);
    let far_child = select(node.left, node.right, left_first);
    let enter_near = near_passes && near_child < LEAF_BIT;
    let enter_far = far_passes && far_child < LEAF_BIT;
    let test_near = near_passes && near_child >= LEAF_BIT;
    let test_far = far_passes && far_child >= LEAF_BIT;
    return Visit(
        select(select(NO_ROOT, far_child, enter_far), near_child, enter_near),
        select(NO_ROOT, far_child, enter_near && enter_far),
        select(select(NO_ROOT, far_child, test_far), near_child, test_near),
        select(NO_ROOT, far_child, test_near && test_far),
    );
}

// Leaves are tested as soon as their parent is visited, nearer first, and only nodes wait on the stack. With `any` the
// walk ends at its first hit.
// The hit of least (t, triangle), or, where `any`, some hit. Triangle `except` is passed through.
fn traverse(ray: Ray, root: u32, any: bool, except: u32) -> Hit {
    var hit = Hit(ray.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    if root == NO_ROOT || all(ray.direction == vec3(0.0)) {
        return hit;
    }
    let query = prepare_query(ray, scene_extent(root));
    var stack: array<u32, STACK_SIZE>;
    // Entries pushed and not popped, and how many of them, from the oldest, were forgotten.
    var top = 0u;
    var bottom = 0u;
    var last = root;
    var visit = Visit(root, NO_ROOT, NO_ROOT, NO_ROOT);
    if root >= LEAF_BIT {
        visit = Visit(NO_ROOT, NO_ROOT, root, NO_ROOT);
    }
    var walking = true;
    while walking && hit.steps < MAX_STEPS {
        for (var i = 0u; i < VISITS_PER_LEAF && visit.first_leaf == NO_ROOT; i += 1u) {
            if visit.next == NO_ROOT {
                if top != bottom {
                    top -= 1u;
                    visit.next = stack[top % STACK_SIZE];
                } else if bottom != 0u {
                    visit.next = climb(query, last, &hit);
                }
                if visit.next == NO_ROOT {
                    walking = false;
                    break;
                }
            }
            hit.steps += 1u;
            last = visit.next;
            visit = visit_node(query, last, hit.t);
            if visit.later != NO_ROOT {
                stack[top % STACK_SIZE] = visit.later;
                top += 1u;
                bottom = max(bottom, max(top, STACK_SIZE) - STACK_SIZE);
            }
        }
        if visit.first_leaf != NO_ROOT {
            test_leaf(query, visit.first_leaf & ~LEAF_BIT, except, &hit);
            visit.first_leaf = visit.second_leaf;
            visit.second_leaf = NO_ROOT;
            walking = !(any && hit.triangle != NO_HIT);
        }
    }
    return hit;
}

// The hit of least (t, triangle).
fn closest_hit(ray: Ray, root: u32) -> Hit {
    return traverse(ray, root, false, NO_HIT);
}

// Whether anything lies between the ray's ends.
fn any_hit(ray: Ray, root: u32) -> bool {
    return traverse(ray, root, true, NO_HIT).triangle != NO_HIT;
}
