//! What counts as lying far beyond the rest of a scene.

use glam::Vec3;
use lucerna::cpu::morton;
use lucerna::scene::generate::{spheres, terrain};

use crate::morton::{cloud, point, triangle};

#[test]
fn scenes_that_fill_their_box_keep_cells_of_one_size() {
    let generated = [spheres(20_000, 7), terrain(20_000, 7)].map(|scene| {
        let corners = scene.iter().zip(0..);
        corners.map(|([a, b, c], index)| triangle(index, *a, *b, *c)).collect::<Vec<_>>()
    });
    let line = cloud(5_000, 0.0, |i, _| Vec3::new(i as f32 / 2_500.0 - 1.0, 0.0, 0.0));
    for (which, triangles) in
        generated.iter().chain([&cloud(4_000, 0.03, |_, random| point(random)), &line]).enumerate()
    {
        let centroids = morton::bounds(triangles).centroids;
        let reach = centroids.high.max(-centroids.low).max_element();
        assert!(reach <= morton::core_of(triangles), "scene {which} reaches {reach}");
    }
}
