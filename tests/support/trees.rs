//! Trees that no pass has built, of scenes made to be hard to hit.

use glam::{Vec3, Vec4};
use lucerna::cpu::bounds::Bounds;
use lucerna::cpu::tree::Tree;
use lucerna::layout::ray::{Ray, T_FAR};
use lucerna::layout::tree::{LEAF_BIT, NO_ROOT, Node, Triangle};
use lucerna::scene::generate::{Corners, SplitMix, icosphere};

/// How a run of leaves is cut in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// At the median of the centroids along the widest axis.
    Median,
    /// Leaves shuffled, and cut anywhere: boxes overlap, and the order of leaves means nothing.
    Random(u64),
    /// After the first two leaves: half as deep as there are leaves.
    Chain,
}

/// Corners as records, indexed as listed.
pub fn records(triangles: &[Corners]) -> Vec<Triangle> {
    let record =
        |(i, [a, b, c]): (usize, &Corners)| Triangle { a: *a, b: *b, c: *c, index: i as u32, ..Triangle::default() };
    triangles.iter().enumerate().map(record).collect()
}

/// A range of leaves that waits for its place in the tree: its parent, and whether it is the left child.
struct Waiting {
    first: usize,
    last: usize,
    parent: u32,
    is_left: bool,
}

/// A valid tree over all triangles.
pub fn build(triangles: &[Corners], cut: Cut) -> Tree {
    let mut leaves = records(triangles);
    let mut random = SplitMix(if let Cut::Random(seed) = cut { seed } else { 0 });
    if let Cut::Random(_) = cut {
        for i in (1..leaves.len()).rev() {
            leaves.swap(i, (random.next_u64() % (i as u64 + 1)) as usize);
        }
    }
    let mut nodes: Vec<Node> = Vec::new();
    let mut waiting = vec![Waiting { first: 0, last: leaves.len(), parent: NO_ROOT, is_left: false }];
    while let Some(Waiting { first, last, parent, is_left }) = waiting.pop() {
        let word = if last - first < 2 { LEAF_BIT | first as u32 } else { nodes.len() as u32 };
        if parent != NO_ROOT {
            let node = &mut nodes[parent as usize];
            *(if is_left { &mut node.left } else { &mut node.right }) = word;
        }
        if last - first < 2 {
            continue;
        }
        let split = first + choose(&mut leaves[first..last], cut, &mut random);
        nodes.push(Node { leaves: (last - first) as u32, parent, ..Node::default() });
        waiting.push(Waiting { first: split, last, parent: word, is_left: false });
        waiting.push(Waiting { first, last: split, parent: word, is_left: true });
    }
    let mut tree = Tree { leaves, nodes };
    fill_boxes(&mut tree);
    tree
}

/// How many leaves go left, at least one and not all.
fn choose(leaves: &mut [Triangle], cut: Cut, random: &mut SplitMix) -> usize {
    match cut {
        Cut::Chain => 2.min(leaves.len() - 1),
        Cut::Random(_) => 1 + (random.next_u64() % (leaves.len() as u64 - 1)) as usize,
        Cut::Median => {
            let centre = |t: &Triangle| t.a + t.b + t.c;
            let boxes = leaves.iter().map(|t| Bounds { low: centre(t), high: centre(t) });
            let all = boxes.fold(Bounds::EMPTY, Bounds::joined);
            let axis = (all.high - all.low).max_position();
            leaves.sort_by(|p, q| centre(p)[axis].total_cmp(&centre(q)[axis]).then(p.index.cmp(&q.index)));
            leaves.len() / 2
        }
    }
}

/// Children come after their parents, so that the last node is done first.
fn fill_boxes(tree: &mut Tree) {
    let mut boxes = vec![Bounds::EMPTY; tree.nodes.len()];
    for i in (0..tree.nodes.len()).rev() {
        let of = |child: u32| match child & LEAF_BIT {
            0 => boxes[child as usize],
            _ => Bounds::padded(&tree.leaves[(child & !LEAF_BIT) as usize]),
        };
        let (left, right) = (of(tree.nodes[i].left), of(tree.nodes[i].right));
        let along = |axis: usize| Vec4::new(left.low[axis], left.high[axis], right.low[axis], right.high[axis]);
        (tree.nodes[i].x, tree.nodes[i].y, tree.nodes[i].z) = (along(0), along(1), along(2));
        boxes[i] = left.joined(right);
    }
}

/// A point in the cube of half width `size`.
pub fn point_in_cube(random: &mut SplitMix, size: f32) -> Vec3 {
    let mut coordinate = || random.range(-1.0, 1.0) as f32 * size;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// A unit vector, uniform over the sphere.
pub fn direction(random: &mut SplitMix) -> Vec3 {
    let z = random.range(-1.0, 1.0);
    let (sin, cos) = random.range(0.0, std::f64::consts::TAU).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    glam::DVec3::new(r * cos, r * sin, z).as_vec3()
}

/// A ray without ends.
pub fn endless(origin: Vec3, direction: Vec3) -> Ray {
    Ray { origin, t_min: 0.0, direction, t_max: T_FAR }
}

/// Rays from and to anywhere in a cube of half width `size`.
pub fn random_rays(count: usize, size: f32, seed: u64) -> Vec<Ray> {
    let mut random = SplitMix(seed);
    (0..count).map(|_| endless(point_in_cube(&mut random, size), direction(&mut random))).collect()
}

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
