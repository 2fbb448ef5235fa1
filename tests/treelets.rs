//! Treelets joined anew: what it saves, that no hit depends on it, and that no shape of scene makes it a chain. That kernels make the same
//! tree as the twin, module `tree` holds.

use glam::Vec3;
use lucerna::cpu::intersect::Fma;
use lucerna::cpu::traverse::closest_hit;
use lucerna::cpu::tree::{self, Tree};
use lucerna::cpu::tree_check::measure;
use lucerna::cpu::treelets::treelets;
use lucerna::layout::tree::{TREELET_LEVELS, TREELET_SIZE, TREELET_TURNS, Triangle, treelet_levels, treelet_words};
use lucerna::scene::generate;
use lucerna::stress::scenes::rays::random_rays;
use lucerna::stress::tools::trees::records;

use crate::morton::triangle;

fn cost(tree: &Tree) -> f64 {
    measure(&tree.leaves, &tree.nodes).unwrap().sah
}

#[test]
fn a_tree_of_spheres_costs_four_fifths_of_that_by_codes() {
    for count in [20_000, 100_000] {
        let triangles = records(&generate::spheres(count, 7));
        let ratio = cost(&tree::build(&triangles)) / cost(&tree::by_codes(&triangles));
        assert!((0.6..0.80).contains(&ratio), "{count} triangles: {ratio}");
    }
}

#[test]
fn no_hit_depends_on_it() {
    let triangles = records(&generate::spheres(5_000, 3));
    let (plain, joined) = (tree::by_codes(&triangles), tree::build(&triangles));
    assert_ne!(plain.nodes, joined.nodes);
    let mut nodes = plain.nodes.clone();
    treelets(&mut nodes);
    assert_eq!(nodes, joined.nodes);
    let rays = random_rays(3_000, 3.0, 5);
    let mut hits = 0;
    for ray in &rays {
        let [a, b] = [&plain, &joined].map(|tree| closest_hit(Fma::Fused, ray, tree));
        assert_eq!((a.t.to_bits(), a.triangle), (b.t.to_bits(), b.triangle), "{ray:?}");
        hits += usize::from(a.t < ray.t_max);
    }
    assert!(hits > 300, "{hits} of {} rays hit anything", rays.len());
}

/// Shells in shells, each a little larger than the last: of two boxes that lie in one another, that of both is the larger one.
#[test]
fn shells_in_shells_make_no_chain() {
    for n in [TREELET_SIZE, 5_000] {
        let shell = |i: u32| {
            let size = 1.001_f32.powi(i as i32);
            triangle(
                i,
                Vec3::new(-size, -size, 0.5 * size),
                Vec3::new(size, -size, -0.5 * size),
                Vec3::new(0.0, 2.0 * size, 0.0),
            )
        };
        let triangles: Vec<Triangle> = (0..n).map(shell).collect();
        let mut nodes = tree::nodes(&vec![0; n as usize], &triangles);
        treelets(&mut nodes);
        let depth = measure(&triangles, &nodes).unwrap().depth;
        // A turn adds a node to the depth, at most, and so does each time that what is left is halved.
        let most = (TREELET_TURNS + TREELET_SIZE.ilog2()) * treelet_levels(n).count() as u32;
        assert!(depth <= most, "{n} shells: {depth} deep");
    }
}

#[test]
fn each_level_has_room_for_its_roots() {
    for count in [3, 255, 256, 257, 2_048, 2_049, 100_000, 8_000_000, 1 << 29] {
        let levels: Vec<_> = treelet_levels(count).collect();
        assert!(levels.len() <= TREELET_LEVELS as usize);
        assert!(levels.last().unwrap().limit >= count, "the whole tree is a treelet of the last level");
        let ends = levels[1..].iter().map(|next| next.first).chain([treelet_words(count)]);
        for (level, end) in levels.iter().zip(ends) {
            // They don't overlap, and each has more leaves than the level before may have.
            assert_eq!(end - level.first, count / (level.before + 1), "{count} triangles, {level:?}");
            assert!(level.below < level.limit);
        }
    }
    assert_eq!([0, 1, 2].map(|count| treelet_levels(count).count()), [0; 3]);
}
