//! Triangles by the place of their centroids: what makes a tree deep, flat or ambiguous.

use glam::Vec3;

use crate::layout::tree::Triangle;
use crate::scene::generate::SplitMix;

/// In the unit cube.
pub fn point(random: &mut SplitMix) -> Vec3 {
    Vec3::from_array([0; 3].map(|_| random.unit() as f32))
}

pub fn triangle(index: u32, a: Vec3, b: Vec3, c: Vec3) -> Triangle {
    Triangle { a, index, b, material: index % 7, c, flags: 0 }
}

/// Triangles of about `size` around a point that `place` gives for each index.
pub fn cloud(n: u32, size: f32, mut place: impl FnMut(u32, &mut SplitMix) -> Vec3) -> Vec<Triangle> {
    let mut random = SplitMix(u64::from(n));
    let around = |at: Vec3, random: &mut SplitMix| at + (point(random) - 0.5) * size;
    (0..n)
        .map(|index| {
            let at = place(index, &mut random);
            let corners = [0; 3].map(|_| around(at, &mut random));
            triangle(index, corners[0], corners[1], corners[2])
        })
        .collect()
}

/// Half of the triangles' centres lie in an eighth of the space of the other half, and so on: as deep as codes go.
pub fn clustered(n: u32) -> Vec<Triangle> {
    cloud(n, 0.0, |_, random| point(random) * 0.5f32.powi((random.next_u64() % 24) as i32))
}

/// Scenes of `n` triangles that ask for something special.
pub fn scenes(n: u32) -> Vec<(&'static str, Vec<Triangle>)> {
    let along = |i: u32| i as f32 / n.max(1) as f32;
    let slivers = |n: u32| {
        let mut all = cloud(n, 0.0, |_, random| point(random));
        for (triangle, i) in all.iter_mut().zip(0..) {
            triangle.b = triangle.a + Vec3::new(1.0, 1e-6, 0.0);
            triangle.c = triangle.a + Vec3::new(0.5, 0.0, if i % 2 == 0 { 1e-6 } else { 0.0 });
        }
        all
    };
    vec![
        ("random", cloud(n, 0.02, |_, random| point(random))),
        ("all equal", (0..n).map(|i| triangle(i, Vec3::ONE, Vec3::X, Vec3::Y)).collect()),
        ("points all equal", (0..n).map(|i| triangle(i, Vec3::ONE, Vec3::ONE, Vec3::ONE)).collect()),
        ("reversed", cloud(n, 0.0, |i, _| Vec3::splat(1.0 - along(i)))),
        ("two opposite corners", cloud(n, 0.0, |i, _| Vec3::splat((i % 2) as f32))),
        ("flat", cloud(n, 0.0, |_, random| point(random) * Vec3::new(1.0, 0.0, 1.0))),
        ("collinear", cloud(n, 0.0, |i, _| Vec3::new(0.0, along(i), 0.0))),
        ("a few centres", cloud(n, 0.0, |i, _| Vec3::new((i % 3) as f32, (i % 2) as f32, 0.0))),
        ("clustered", clustered(n)),
        ("slivers", slivers(n)),
        ("tiny", cloud(n, 0.02 / 1048576.0, |_, random| point(random) / 1048576.0)),
        ("huge", cloud(n, 1e4, |_, random| (point(random) - 0.5) * 1048576.0)),
        ("far away", cloud(n, 0.2, |_, random| point(random) + 1e6)),
        ("one far away", cloud(n, 0.02, |i, random| point(random) - if i == n / 2 { 1e6 } else { 0.0 })),
        ("around zero", cloud(n, 0.0, |i, _| Vec3::new(if i % 2 == 0 { 0.0 } else { -0.0 }, -along(i), along(i)))),
    ]
}
