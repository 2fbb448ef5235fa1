//! Twin of `shaders/passes/trace/traverse.wgsl`: the same hits. The walk visits the same nodes in the same order;
//! its stack grows, where the other forgets and climbs.

use crate::cpu::intersect::{Query, intersect_triangle, prepare_query, slab_interval};
use crate::layout::ray::{Hit, NO_HIT, Ray};
use crate::layout::tree::{LEAF_BIT, NO_ROOT, Node, Triangle};
use glam::{Vec2, Vec3, Vec4};

/// A tree as the passes leave it.
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a> {
    /// Node 0 is the root of two or more leaves.
    pub nodes: &'a [Node],
    /// Triangles in leaf order.
    pub leaves: &'a [Triangle],
    /// What `tree::root` says of the number of leaves.
    pub root: u32,
}

/// The boxes of a node's children, as (least, greatest corner).
pub fn child_boxes(node: &Node) -> [(Vec3, Vec3); 2] {
    let corner = |i: usize| Vec3::new(node.x[i], node.y[i], node.z[i]);
    [(corner(0), corner(1)), (corner(2), corner(3))]
}

/// The greatest coordinate of the scene's box; there is at least one triangle.
pub fn scene_extent(tree: &Tree) -> f32 {
    if tree.root >= LEAF_BIT {
        let leaf = &tree.leaves[(tree.root & !LEAF_BIT) as usize];
        return [leaf.a, leaf.b, leaf.c].map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f32::max);
    }
    let root = &tree.nodes[tree.root as usize];
    [root.x, root.y, root.z].map(Vec4::abs).map(Vec4::max_element).into_iter().fold(0.0, f32::max)
}

fn miss(ray: &Ray) -> Hit {
    Hit { t: ray.t_max, triangle: NO_HIT, ..Hit::default() }
}

/// Whether the two can hit each other at all.
fn is_traceable(ray: &Ray, root: u32) -> bool {
    root != NO_ROOT && ray.direction != Vec3::ZERO
}

fn test_leaf(query: &Query, leaf: usize, tree: &Tree, hit: &mut Hit) {
    let triangle = &tree.leaves[leaf];
    let Some(found) = intersect_triangle(query, triangle.a, triangle.b, triangle.c) else {
        return;
    };
    if found.t <= query.t_min || found.t >= query.t_max {
        return;
    }
    if found.t < hit.t || (found.t == hit.t && triangle.index < hit.triangle) {
        *hit = Hit {
            t: found.t,
            triangle: triangle.index,
            leaf: leaf as u32,
            b1: found.b1,
            b2: found.b2,
            steps: hit.steps,
        };
    }
}

fn passes(interval: Vec2, query: &Query, t: f32) -> bool {
    interval.x <= interval.y.min(t) && interval.y >= query.t_min
}

fn traverse(ray: &Ray, tree: &Tree, any: bool) -> Hit {
    let mut hit = miss(ray);
    if !is_traceable(ray, tree.root) {
        return hit;
    }
    let query = prepare_query(ray, scene_extent(tree));
    let leaf_of = |child: u32| (child & !LEAF_BIT) as usize;
    if tree.root >= LEAF_BIT {
        test_leaf(&query, leaf_of(tree.root), tree, &mut hit);
        return hit;
    }
    let mut stack = vec![tree.root];
    while let Some(index) = stack.pop() {
        hit.steps += 1;
        let node = &tree.nodes[index as usize];
        let at = child_boxes(node).map(|(low, high)| slab_interval(&query, low, high));
        let mut children = [(node.left, at[0]), (node.right, at[1])];
        if at[1].x < at[0].x {
            children.reverse();
        }
        let t = hit.t;
        let entered = children.into_iter().filter(|(_, at)| passes(*at, &query, t)).map(|(child, _)| child);
        stack.extend(entered.clone().rev().filter(|child| *child < LEAF_BIT));
        for child in entered.filter(|child| *child >= LEAF_BIT) {
            test_leaf(&query, leaf_of(child), tree, &mut hit);
        }
        if any && hit.triangle != NO_HIT {
            break;
        }
    }
    hit
}

/// The hit of least (t, triangle).
pub fn closest_hit(ray: &Ray, tree: &Tree) -> Hit {
    traverse(ray, tree, false)
}

/// Whether anything lies between the ray's ends.
pub fn any_hit(ray: &Ray, tree: &Tree) -> bool {
    traverse(ray, tree, true).triangle != NO_HIT
}

/// What [`closest_hit`] finds, by testing every leaf: the oracle of every tree. Its `steps` is 0.
pub fn closest_hit_brute(ray: &Ray, tree: &Tree) -> Hit {
    let mut hit = miss(ray);
    if is_traceable(ray, tree.root) {
        let query = prepare_query(ray, scene_extent(tree));
        for leaf in 0..tree.leaves.len() {
            test_leaf(&query, leaf, tree, &mut hit);
        }
    }
    hit
}
