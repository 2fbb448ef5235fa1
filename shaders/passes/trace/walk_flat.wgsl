// A walk for processors, which run a body to its end for the lanes that left in its middle, and what stands under an `if`, or in a loop
// there, even for none (lavapipe). So both loops are left at their ends, and a step up is a round like any other.

import package::gen::{Hit, LEAF_BIT, MAX_STEPS, NO_HIT, NO_ROOT};
import package::lib::intersect::{Query};
import package::lib::traverse_config::{STACK_SIZE, VISITS_PER_LEAF};
import package::passes::trace::children::{child_intervals, interval_passes};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node};

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

// From `root`; nowhere, if that is NO_ROOT. See package::passes::trace::traverse.
fn walk(query: Query, root: u32, enough: f32) -> Hit {
    var hit = Hit(query.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    var stack: array<u32, STACK_SIZE>;
    // Entries pushed and not popped, and how many of them, from the oldest, were forgotten.
    var top = 0u;
    var bottom = 0u;
    var walking = root != NO_ROOT;
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
            test_leaf(query, walk.first_leaf & ~LEAF_BIT, &hit);
            walk.first_leaf = walk.second_leaf;
            walk.second_leaf = NO_ROOT;
            walking = hit.t >= enough;
        }
        continuing {
            break if !walking;
        }
    }
    return hit;
}
