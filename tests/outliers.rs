//! One thing a million times farther away than all else, or a dome around it: the rest of the scene costs what it cost.

use glam::Vec3;
use lucerna::cpu::intersect::Fma;
use lucerna::cpu::morton;
use lucerna::cpu::traverse::{closest_hit, closest_hit_brute};
use lucerna::cpu::tree::build;
use lucerna::layout::ray::Ray;
use lucerna::layout::tree::Triangle;
use lucerna::scene::generate::{SplitMix, spheres, terrain};

use crate::morton::{cloud, point, triangle};
use crate::support::trees::{direction, endless};

/// 4,000 small triangles in the unit cube, in no order that a tree could live by.
fn near() -> Vec<Triangle> {
    cloud(4_000, 0.03, |_, random| point(random))
}

fn with(mut triangles: Vec<Triangle>, more: impl IntoIterator<Item = [Vec3; 3]>) -> Vec<Triangle> {
    for [a, b, c] in more {
        triangles.push(triangle(triangles.len() as u32, a, b, c));
    }
    triangles
}

/// A sky's dome: an octahedron whose faces are cut into 4^5.
fn dome(radius: f32) -> Vec<[Vec3; 3]> {
    let mut faces: Vec<[Vec3; 3]> = Vec::new();
    for (x, y, z) in [(1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, -1.0)] {
        for sign in [1.0, -1.0] {
            faces.push([Vec3::X * x * sign, Vec3::Y * y * sign, Vec3::Z * z * sign]);
        }
    }
    for _ in 0..5 {
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [d, e, f] = [(a + b), (b + c), (c + a)].map(Vec3::normalize);
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
            })
            .collect();
    }
    faces.into_iter().map(|face| face.map(|v| v * radius)).collect()
}

fn rays() -> Vec<Ray> {
    let mut random = SplitMix(3);
    (0..500).map(|_| endless(point(&mut random), direction(&mut random))).collect()
}

/// Nodes that a ray visits, on average; each hit equals that of all triangles tried one by one.
fn steps(triangles: &[Triangle]) -> f64 {
    let tree = build(triangles);
    let mut steps = 0;
    for ray in rays() {
        let hit = closest_hit(Fma::Fused, &ray, &tree);
        let brute = closest_hit_brute(Fma::Fused, &ray, &tree);
        assert_eq!((hit.t, hit.triangle), (brute.t, brute.triangle), "{ray:?}");
        steps += hit.steps;
    }
    f64::from(steps) / 500.0
}

#[test]
fn one_thing_far_away_costs_the_rest_nothing() {
    let alone = steps(&near());
    for far in [1e5, 1e6, 1e7] {
        let quad = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|v| Vec3::splat(far) + v);
        let beside = steps(&with(near(), [quad, quad.map(|v| -v)]));
        // A node or two above the rest, and cells of half the bits: 20 % covers both; the whole was 30 times dearer.
        assert!(beside < 1.2 * alone + 2.0, "{beside} nodes a ray with a thing at {far:e}, {alone} without");
        let sky = steps(&with(Vec::new(), dome(far)));
        let below = steps(&with(near(), dome(far)));
        assert!(
            below < 1.2 * (alone + sky) + 2.0,
            "{below} nodes a ray below a dome at {far:e}, {alone} and {sky} apart"
        );
    }
}

#[test]
fn scenes_that_fill_their_box_keep_cells_of_one_size() {
    let generated = [spheres(20_000, 7), terrain(20_000, 7)].map(|scene| {
        let corners = scene.iter().zip(0..);
        corners.map(|([a, b, c], index)| triangle(index, *a, *b, *c)).collect::<Vec<_>>()
    });
    let line = cloud(5_000, 0.0, |i, _| Vec3::new(i as f32 / 2_500.0 - 1.0, 0.0, 0.0));
    for (which, triangles) in generated.iter().chain([&near(), &line]).enumerate() {
        let centroids = morton::bounds(triangles).centroids;
        let reach = centroids.high.max(-centroids.low).max_element();
        assert!(reach <= morton::core_of(triangles), "scene {which} reaches {reach}");
    }
}
