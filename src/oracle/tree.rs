//! Closest hits in f64: a box tree split at the median, and triangles by Moeller and Trumbore (1997).

use std::ops::Range;

use glam::DVec3;

/// Triangles up to which a node is a leaf.
const LEAF_SIZE: usize = 4;

/// Boxes grow by this part of the scene's greatest coordinate, against the rounding of slabs.
const GROWTH: f64 = 1e-12;

/// Hits nearer than this part of the scene's greatest coordinate are of the surface that a ray starts on.
const LEAST_T: f64 = 1e-10;

/// The median halves what is left, so a tree of fewer than 2^32 triangles is no deeper.
const DEEPEST: usize = 33;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub t: f64,
    /// Barycentric weights of the second and third corner.
    pub b: [f64; 2],
    /// Index in the list that the tree was made from.
    pub triangle: u32,
}

pub struct Tree {
    /// In the order of the leaves, each with its index.
    triangles: Vec<([DVec3; 3], u32)>,
    nodes: Vec<Node>,
    /// The scene's greatest coordinate.
    extent: f64,
}

struct Node {
    low: DVec3,
    high: DVec3,
    content: Content,
}

enum Content {
    Leaf(Range<usize>),
    /// The first child is the next node; it is the lower one along `axis`.
    Inner {
        second: usize,
        axis: usize,
    },
}

impl Tree {
    pub fn new(triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let triangles: Vec<_> = triangles.zip(0..).collect();
        let greatest = |corners: &[DVec3; 3]| corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
        let extent = triangles.iter().map(|(corners, _)| greatest(corners)).fold(0.0, f64::max);
        let mut tree = Self { nodes: Vec::new(), triangles, extent };
        if !tree.triangles.is_empty() {
            tree.split(0..tree.triangles.len());
        }
        tree
    }

    fn split(&mut self, range: Range<usize>) {
        let corners = || self.triangles[range.clone()].iter().flat_map(|(corners, _)| *corners);
        let low = corners().fold(DVec3::MAX, DVec3::min) - GROWTH * self.extent;
        let high = corners().fold(DVec3::MIN, DVec3::max) + GROWTH * self.extent;
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, content: Content::Leaf(range.clone()) });
        if range.len() <= LEAF_SIZE {
            return;
        }
        let axis = (high - low).max_position();
        let centre = |(corners, _): &([DVec3; 3], u32)| corners.iter().map(|c| c[axis]).sum::<f64>();
        let half = range.len() / 2;
        self.triangles[range.clone()].select_nth_unstable_by(half, |a, b| centre(a).total_cmp(&centre(b)));
        self.split(range.start..range.start + half);
        self.nodes[node].content = Content::Inner { second: self.nodes.len(), axis };
        self.split(range.start + half..range.end);
    }

    /// The hit of least (t, triangle) beyond the surface that the ray starts on, of those that are there. A triangle's hit is
    /// asked for once at most.
    pub fn closest(&self, origin: DVec3, direction: DVec3, mut is_there: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        // So that 0 times the inverse is a number.
        let inverse = direction.map(|d| 1.0 / if d.abs() < 1e-300 { 1e-300 } else { d });
        let mut best: Option<Hit> = None;
        let mut stack = [0; DEEPEST];
        let mut held = usize::from(!self.nodes.is_empty());
        while held > 0 {
            held -= 1;
            let index = stack[held];
            let node = &self.nodes[index];
            if !node.meets(origin, inverse, best.map_or(f64::MAX, |hit| hit.t)) {
                continue;
            }
            match &node.content {
                Content::Inner { second, axis } => {
                    let (near, far) = if direction[*axis] < 0.0 { (*second, index + 1) } else { (index + 1, *second) };
                    stack[held] = far;
                    stack[held + 1] = near;
                    held += 2;
                }
                Content::Leaf(range) => {
                    let found = self.triangles[range.clone()].iter().filter_map(|t| intersect(t, origin, direction));
                    for hit in found.filter(|hit| hit.t > LEAST_T * self.extent) {
                        let before =
                            |best: &Hit| hit.t.total_cmp(&best.t).then(hit.triangle.cmp(&best.triangle)).is_lt();
                        if best.as_ref().is_none_or(before) && is_there(&hit) {
                            best = Some(hit);
                        }
                    }
                }
            }
        }
        best
    }
}

impl Node {
    fn meets(&self, origin: DVec3, inverse: DVec3, t_max: f64) -> bool {
        let (a, b) = ((self.low - origin) * inverse, (self.high - origin) * inverse);
        let near = a.min(b).max_element().max(0.0);
        let far = a.max(b).min_element().min(t_max);
        near <= far
    }
}

fn intersect((corners, index): &([DVec3; 3], u32), origin: DVec3, direction: DVec3) -> Option<Hit> {
    let [a, b, c] = *corners;
    let (e, f) = (b - a, c - a);
    let p = direction.cross(f);
    let det = e.dot(p);
    if det == 0.0 {
        return None;
    }
    let scale = 1.0 / det;
    let to_origin = origin - a;
    let u = to_origin.dot(p) * scale;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let q = to_origin.cross(e);
    let v = direction.dot(q) * scale;
    (v >= 0.0 && u + v <= 1.0).then(|| Hit { t: f.dot(q) * scale, b: [u, v], triangle: *index })
}
