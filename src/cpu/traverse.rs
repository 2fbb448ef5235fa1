//! Twin of `shaders/passes/trace/traverse.wgsl`: the same hits. The walk visits the same nodes in the same order;
//! its stack grows, where the other forgets and climbs.

use glam::{Vec2, Vec3, Vec4};

use super::intersect::{Fma, Query, intersect_triangle, prepare_query, slab_interval};
use super::node_boxes::child_boxes;
use super::tree::Tree;
use crate::layout::ray::{Hit, NO_HIT, Ray};
use crate::layout::tree::{LEAF_BIT, Triangle, root};

/// The greatest coordinate of the scene's box; 0 without triangles.
pub fn scene_extent(tree: &Tree) -> f32 {
    match (tree.nodes.first(), tree.leaves.first()) {
        (Some(root), _) => [root.x, root.y, root.z].map(|v| Vec4::abs(v).max_element()).into_iter().fold(0.0, f32::max),
        (None, Some(leaf)) => [leaf.a, leaf.b, leaf.c].map(|v| v.abs().max_element()).into_iter().fold(0.0, f32::max),
        (None, None) => 0.0,
    }
}

fn miss(ray: &Ray) -> Hit {
    Hit { t: ray.t_max, triangle: NO_HIT, ..Hit::default() }
}

/// Whether the two can hit each other at all.
fn is_traceable(ray: &Ray, tree: &Tree) -> bool {
    !tree.leaves.is_empty() && ray.direction != Vec3::ZERO
}

/// Whether a point that a ray meets is there for it.
pub type IsThere<'a> = &'a dyn Fn(&Triangle, &Hit) -> bool;

fn test_leaf(query: &Query, leaf: usize, tree: &Tree, is_there: IsThere, hit: &mut Hit) {
    let triangle = &tree.leaves[leaf];
    let Some(found) = intersect_triangle(query, triangle.a, triangle.b, triangle.c) else {
        return;
    };
    if found.t <= query.t_min {
        return;
    }
    if found.t < hit.t || (found.t == hit.t && triangle.index < hit.triangle) {
        let (t, b1, b2) = (found.t, found.b1, found.b2);
        let nearer = Hit { t, triangle: triangle.index, leaf: leaf as u32, b1, b2, steps: hit.steps };
        if is_there(triangle, &nearer) {
            *hit = nearer;
        }
    }
}

fn passes(interval: Vec2, query: &Query, t: f32) -> bool {
    interval.x <= interval.y.min(t) && interval.y >= query.t_min
}

fn traverse(fma: Fma, ray: &Ray, tree: &Tree, is_there: IsThere, any: bool) -> Hit {
    let mut hit = miss(ray);
    if !is_traceable(ray, tree) {
        return hit;
    }
    let query = prepare_query(fma, ray, scene_extent(tree));
    let root = root(tree.leaves.len() as u32);
    if root >= LEAF_BIT {
        test_leaf(&query, (root & !LEAF_BIT) as usize, tree, is_there, &mut hit);
        return hit;
    }
    let mut stack = vec![root];
    while let Some(index) = stack.pop() {
        hit.steps += 1;
        let node = &tree.nodes[index as usize];
        let [left, right] = child_boxes(node).map(|bounds| slab_interval(&query, bounds));
        let mut children = [(node.left, left), (node.right, right)];
        if right.x < left.x {
            children.reverse();
        }
        let t = hit.t;
        let entered = children.into_iter().filter(|(_, at)| passes(*at, &query, t)).map(|(child, _)| child);
        stack.extend(entered.clone().rev().filter(|child| *child < LEAF_BIT));
        for child in entered.filter(|child| *child >= LEAF_BIT) {
            test_leaf(&query, (child & !LEAF_BIT) as usize, tree, is_there, &mut hit);
        }
        if any && hit.triangle != NO_HIT {
            break;
        }
    }
    hit
}

/// The hit of least (t, triangle).
pub fn closest_hit(fma: Fma, ray: &Ray, tree: &Tree) -> Hit {
    closest_hit_of(fma, ray, tree, &|_, _| true)
}

/// The same of what is there for the ray.
pub fn closest_hit_of(fma: Fma, ray: &Ray, tree: &Tree, is_there: IsThere) -> Hit {
    traverse(fma, ray, tree, is_there, false)
}

/// Whether anything lies between the ray's ends.
pub fn any_hit(fma: Fma, ray: &Ray, tree: &Tree) -> bool {
    traverse(fma, ray, tree, &|_, _| true, true).triangle != NO_HIT
}

/// What [`closest_hit`] finds, by testing every leaf: the oracle of every tree. Its `steps` is 0.
pub fn closest_hit_brute(fma: Fma, ray: &Ray, tree: &Tree) -> Hit {
    let mut hit = miss(ray);
    if is_traceable(ray, tree) {
        let query = prepare_query(fma, ray, scene_extent(tree));
        for leaf in 0..tree.leaves.len() {
            test_leaf(&query, leaf, tree, &|_, _| true, &mut hit);
        }
    }
    hit
}
