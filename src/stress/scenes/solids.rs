//! Triangles that are hard to hit, or hard to make a tree of.

use glam::Vec3;

use super::rays::point_in_cube;
use crate::scene::generate::{Corners, SplitMix, icosphere};

/// Triangles anywhere in the unit cube, up to `size` wide.
pub fn soup(count: usize, size: f32, seed: u64) -> Vec<Corners> {
    let mut random = SplitMix(seed);
    let mut triangle = || {
        let centre = point_in_cube(&mut random, 1.0);
        [(); 3].map(|()| centre + point_in_cube(&mut random, size))
    };
    (0..count).map(|_| triangle()).collect()
}

/// A sphere of radius 1 without a gap.
pub fn sphere(level: u32) -> Vec<Corners> {
    icosphere(level).into_iter().map(|corners| corners.map(|v| v.as_vec3())).collect()
}

/// Triangles a million times as long as high, closed into prisms around the origin: `count` thin quads in a ring of
/// radius 1, half of them 2e-6 high.
pub fn slivers(count: usize) -> Vec<Corners> {
    let corner = |i: usize, y: f32| {
        let angle = (i % count) as f64 / count as f64 * std::f64::consts::TAU;
        Vec3::new(angle.cos() as f32, y, angle.sin() as f32)
    };
    let mut out = Vec::new();
    let levels = [-1.0f32, -1e-6, 0.0, 1e-6, 1.0];
    for i in 0..count {
        for pair in levels.windows(2) {
            let [a, b, c, d] = [corner(i, pair[0]), corner(i, pair[1]), corner(i + 1, pair[1]), corner(i + 1, pair[0])];
            out.extend([[a, b, c], [a, c, d]]);
        }
        out.push([corner(i, -1.0), corner(i + 1, -1.0), Vec3::NEG_Y]);
        out.push([corner(i, 1.0), corner(i + 1, 1.0), Vec3::Y]);
    }
    out
}

/// Axis-parallel quads on an integer grid: every leaf's box is flat, and boxes touch in planes, edges and corners.
pub fn flat_grid(n: i32) -> Vec<Corners> {
    let mut out = Vec::new();
    for (i, k, level) in (0..n * n * n).map(|cell| (cell % n, cell / n % n, cell / n / n)) {
        let at = |u: i32, v: i32| [(i + u - n / 2) as f32, (k + v - n / 2) as f32, (level - n / 2) as f32];
        for turn in 0..3 {
            let corner = |u, v| {
                let p = at(u, v);
                Vec3::from_array(std::array::from_fn(|axis| p[(axis + turn) % 3]))
            };
            out.extend([[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]]);
        }
    }
    out
}

/// Triangles upon each other: duplicates, turned duplicates, and overlapping ones in one plane, `planes` times.
pub fn coplanar(planes: usize) -> Vec<Corners> {
    let mut out = Vec::new();
    for i in 0..planes {
        let z = i as f32 * 0.25 - 0.5;
        let [a, b, c, d] =
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]: [f32; 2]| Vec3::new(x, y, z + 0.125 * x));
        out.extend([[a, b, c], [b, c, a], [a, b, c], [c, b, a], [a, c, d], [a, b, d], [b, c, d], [c, a, b]]);
    }
    out
}

/// Triangles of zero area in exact arithmetic, of every kind: a point, two equal corners, three in a line.
pub fn degenerate(count: usize) -> Vec<Corners> {
    let mut random = SplitMix(11);
    let mut integer = || (random.range(-8.0, 8.0) as f32).round();
    (0..count)
        .map(|i| {
            let a = Vec3::new(integer(), integer(), integer());
            let step = Vec3::new(integer(), integer(), integer());
            match i % 3 {
                0 => [a, a, a],
                1 => [a, a + step, a],
                _ => [a, a + step, a + step * 3.0],
            }
        })
        .collect()
}

/// Triangles about one centroid.
pub fn concentric(count: usize) -> Vec<Corners> {
    let mut random = SplitMix(5);
    (0..count)
        .map(|_| {
            let quarter = |random: &mut SplitMix| (point_in_cube(random, 64.0)).round() / 64.0;
            let (a, b) = (quarter(&mut random), quarter(&mut random));
            [a, b, -a - b]
        })
        .collect()
}

/// The scenes that are hard to hit, small enough for brute force.
pub fn hard_scenes() -> Vec<(&'static str, Vec<Corners>)> {
    let mut mixed = degenerate(90);
    mixed.extend(coplanar(4).iter().map(|t| t.map(|v| v * 8.0)));
    vec![
        ("soup", soup(200, 0.3, 21)),
        ("sphere", sphere(1)),
        ("slivers", slivers(6)),
        ("flat boxes", flat_grid(3)),
        ("coplanar", coplanar(6)),
        ("degenerate", mixed),
        ("equal centroids", concentric(200)),
    ]
}
