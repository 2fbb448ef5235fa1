//! Polygons to triangles.

use earcut::Earcut;
use glam::DVec3;

/// Triangulates polygons one after another, keeping its buffers.
pub struct Triangulator {
    earcut: Earcut<f64>,
    /// The polygon on its own plane.
    flat: Vec<[f64; 2]>,
    cut: Vec<u32>,
}

/// Triangulates one polygon: three corner numbers a triangle, wound as the polygon is.
pub fn triangulate(polygon: &[DVec3]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    Triangulator::default().run(polygon, &mut triangles);
    triangles
}

impl Default for Triangulator {
    fn default() -> Self {
        Self { earcut: Earcut::new(), flat: Vec::new(), cut: Vec::new() }
    }
}

impl Triangulator {
    /// Appends the polygon's triangles: a fan where that covers it, else ears on the plane of its Newell normal.
    ///
    /// Every corner is used, those on a straight edge too: a neighbour that shares them must find no gap. A polygon
    /// without area becomes a fan without area. Fewer than three corners give nothing.
    pub fn run(&mut self, polygon: &[DVec3], triangles: &mut Vec<[u32; 3]>) {
        let count = polygon.len() as u32;
        if count < 3 {
            return;
        }
        let Some(normal) = newell_normal(polygon).filter(|_| count > 3) else { return fan(0, count, triangles) };
        let hubs = if count == 4 { 2 } else { 1 };
        if let Some(hub) = (0..hubs).find(|hub| fan_covers(polygon, *hub, normal)) {
            return fan(hub, count, triangles);
        }
        let start = triangles.len();
        self.cut_ears(polygon, normal, triangles);
        if triangles.len() == start {
            return fan(0, count, triangles);
        }
        restore_dropped(polygon, start, triangles);
    }

    /// Ear clipping by the `earcut` crate, wound as the polygon is.
    fn cut_ears(&mut self, polygon: &[DVec3], normal: DVec3, triangles: &mut Vec<[u32; 3]>) {
        let (u, v) = normal.any_orthonormal_pair();
        // Coordinates from the first corner: a polygon far from the origin keeps its digits.
        let flatten = |point: &DVec3| [(*point - polygon[0]).dot(u), (*point - polygon[0]).dot(v)];
        self.flat.clear();
        self.flat.extend(polygon.iter().map(flatten));
        self.earcut.earcut_slice(&self.flat, &[], &mut self.cut);
        for corners in self.cut.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            let [p, q, r] = [a, b, c].map(|corner| self.flat[corner as usize]);
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            triangles.push(if area < 0.0 { [a, c, b] } else { [a, b, c] });
        }
    }
}

/// The unit normal of a polygon of any shape, seen counter-clockwise (Newell); `None` where it has no area.
fn newell_normal(polygon: &[DVec3]) -> Option<DVec3> {
    let origin = polygon[0];
    let extent = polygon.iter().map(|point| (*point - origin).abs().max_element()).fold(0.0, f64::max);
    let mut sum = DVec3::ZERO;
    for (i, point) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        sum += ((*point - origin) / extent).cross((next - origin) / extent);
    }
    // Relative to the polygon's own size: below this, what is left of the sum is rounding.
    (sum.length() > 1e-13).then(|| sum.normalize())
}

/// Whether the fan around `hub` covers the polygon once: all its triangles are wound like the polygon.
fn fan_covers(polygon: &[DVec3], hub: u32, normal: DVec3) -> bool {
    let count = polygon.len();
    let at = |i: usize| polygon[(hub as usize + i) % count];
    (1..count - 1).all(|i| (at(i) - at(0)).cross(at(i + 1) - at(0)).dot(normal) > 0.0)
}

/// The triangles of a fan around `hub`.
fn fan(hub: u32, count: u32, triangles: &mut Vec<[u32; 3]>) {
    triangles.extend((1..count - 1).map(|i| [hub, (hub + i) % count, (hub + i + 1) % count]));
}

/// Puts back the corners on straight edges, which ear clipping drops: the triangle at such an edge is split at them.
fn restore_dropped(polygon: &[DVec3], start: usize, triangles: &mut Vec<[u32; 3]>) {
    let count = polygon.len();
    let mut used = vec![false; count];
    for corner in triangles[start..].iter().flatten() {
        used[*corner as usize] = true;
    }
    let Some(first) = (0..count).find(|corner| used[*corner]) else { return };
    let mut chain = vec![first as u32];
    for step in 1..=count {
        let corner = (first + step) % count;
        let last = polygon[*chain.last().expect("invariant: a chain starts with a used corner") as usize];
        if used[corner] || polygon[corner] != last {
            chain.push(corner as u32);
        }
        if used[corner] {
            if chain.len() > 2 {
                split_edge(&chain, start, triangles);
            }
            chain.clear();
            chain.push(corner as u32);
        }
    }
}

/// Replaces the triangle with the edge from the chain's first corner to its last by a fan over the chain.
fn split_edge(chain: &[u32], start: usize, triangles: &mut Vec<[u32; 3]>) {
    let (from, to) = (chain[0], chain[chain.len() - 1]);
    for at in start..triangles.len() {
        let [a, b, c] = triangles[at];
        let apex = match (from, to) {
            edge if edge == (a, b) => c,
            edge if edge == (b, c) => a,
            edge if edge == (c, a) => b,
            _ => continue,
        };
        triangles[at] = [chain[0], chain[1], apex];
        triangles.extend(chain.windows(2).skip(1).map(|edge| [edge[0], edge[1], apex]));
        return;
    }
}
