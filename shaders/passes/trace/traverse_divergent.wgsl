// Traversal for devices whose lanes take turns at branches (GPUs): nodes in an inner loop, leaves and the way up apart.

import package::gen::{Hit, LEAF_BIT, MAX_STEPS, NO_HIT, NO_ROOT};
import package::lib::intersect::{Query};
import package::lib::traverse_config::{STACK_SIZE, VISITS_PER_LEAF};
import package::passes::trace::children::{child_intervals, interval_passes};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node};

// The next node after everything below `last`, or NO_ROOT.
fn climb(query: Query, last: u32, hit: ptr<function, Hit>) -> u32 {
    var child = last;
    while (*hit).steps < MAX_STEPS {
        let parent = load_node(child).parent;
        if parent == NO_ROOT {
            break;
        }
        (*hit).steps += 1u;
        let node = load_node(parent);
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

// What is to be done after a visit of a node; NO_ROOT where there is nothing.
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
    let node = load_node(index);
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

// From `root`; nowhere, if that is NO_ROOT. See package::passes::trace::traverse.
fn traverse_nodes(query: Query, root: u32, enough: f32) -> Hit {
    var hit = Hit(query.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    var stack: array<u32, STACK_SIZE>;
    // Entries pushed and not popped, and how many of them, from the oldest, were forgotten.
    var top = 0u;
    var bottom = 0u;
    var last = root;
    var visit = Visit(root, NO_ROOT, NO_ROOT, NO_ROOT);
    var traversing = root != NO_ROOT;
    if traversing && root >= LEAF_BIT {
        visit = Visit(NO_ROOT, NO_ROOT, root, NO_ROOT);
    }
    while traversing && hit.steps < MAX_STEPS {
        for (var i = 0u; i < VISITS_PER_LEAF && visit.first_leaf == NO_ROOT; i += 1u) {
            if visit.next == NO_ROOT {
                if top != bottom {
                    top -= 1u;
                    visit.next = stack[top % STACK_SIZE];
                } else if bottom != 0u {
                    visit.next = climb(query, last, &hit);
                }
                if visit.next == NO_ROOT {
                    traversing = false;
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
            test_leaf(query, visit.first_leaf & ~LEAF_BIT, &hit);
            visit.first_leaf = visit.second_leaf;
            visit.second_leaf = NO_ROOT;
            traversing = hit.t >= enough;
        }
    }
    return hit;
}
