// Traversal for processors, which run a body to its end for the lanes that left in its middle, and what stands under an `if`, or in a loop
// there, even for none (lavapipe). So both loops are left at their ends, and a step up is a round like any other.

import package::gen::{Hit, LEAF_BIT, MAX_STEPS, NO_HIT, NO_ROOT};
import package::lib::intersect::{Query};
import package::lib::traverse_config::{STACK_SIZE, VISITS_PER_LEAF};
import package::passes::trace::children::{child_intervals, interval_passes};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node};

// Where a traversal is.
struct Traversal {
    // The node to visit next, or NO_ROOT: then one of the stack, or the way up.
    next: u32,
    // The node visited last, and the one above it.
    last: u32,
    parent: u32,
    // Leaves to test, nearer first.
    first_leaf: u32,
    second_leaf: u32,
    // A node for the stack.
    later: u32,
}

// Visits a node: which of its children to enter, which to test. Where the traversal climbs, `below` is the child it comes from; what
// was near is done then, and of what is far a leaf. Else `below` is NO_ROOT.
fn visit_node(query: Query, index: u32, below: u32, t: f32) -> Traversal {
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
    return Traversal(
        select(select(NO_ROOT, far_child, enter_far), near_child, enter_near),
        index,
        node.parent,
        select(select(NO_ROOT, far_child, test_far), near_child, test_near),
        select(NO_ROOT, far_child, test_near && test_far),
        select(NO_ROOT, far_child, enter_near && enter_far),
    );
}

// From `root`; nowhere, if that is NO_ROOT. See package::passes::trace::traverse.
fn traverse_nodes(query: Query, root: u32, enough: f32) -> Hit {
    var hit = Hit(query.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    var stack: array<u32, STACK_SIZE>;
    // Entries pushed and not popped, and how many of them, from the oldest, were forgotten.
    var top = 0u;
    var bottom = 0u;
    var traversing = root != NO_ROOT;
    var traversal = Traversal(root, NO_ROOT, NO_ROOT, NO_ROOT, NO_ROOT, NO_ROOT);
    if traversing && root >= LEAF_BIT {
        traversal.first_leaf = root;
        traversal.next = NO_ROOT;
    }
    loop {
        var visits = 0u;
        loop {
            visits += 1u;
            if traversing && traversal.first_leaf == NO_ROOT {
                var below = NO_ROOT;
                if traversal.next == NO_ROOT {
                    if top != bottom {
                        top -= 1u;
                        traversal.next = stack[top % STACK_SIZE];
                    } else if bottom != 0u {
                        below = traversal.last;
                        traversal.next = traversal.parent;
                    }
                }
                traversing = traversal.next != NO_ROOT && hit.steps < MAX_STEPS;
                if traversing {
                    hit.steps += 1u;
                    traversal = visit_node(query, traversal.next, below, hit.t);
                    if traversal.later != NO_ROOT {
                        stack[top % STACK_SIZE] = traversal.later;
                        top += 1u;
                        bottom = max(bottom, max(top, STACK_SIZE) - STACK_SIZE);
                    }
                }
            }
            continuing {
                break if visits == VISITS_PER_LEAF || !traversing || traversal.first_leaf != NO_ROOT;
            }
        }
        if traversal.first_leaf != NO_ROOT {
            test_leaf(query, traversal.first_leaf & ~LEAF_BIT, &hit);
            traversal.first_leaf = traversal.second_leaf;
            traversal.second_leaf = NO_ROOT;
            traversing = hit.t >= enough;
        }
        continuing {
            break if !traversing;
        }
    }
    return hit;
}
