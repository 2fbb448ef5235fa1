//! Closest hits in f64, plain and independent of the GPU's tree: what the f64 path tracer stands on.

use glam::DVec3;

use crate::layout::tree::Triangle;

/// Triangles up to which a node is a leaf.
const LEAF_SIZE: usize = 4;

/// Triangles and a median-split box tree over them.
pub struct TriangleSet {
    triangles: Vec<TriangleF64>,
    nodes: Vec<BoxNode>,
}

/// A triangle with its corners in f64.
#[derive(Clone, Copy, Debug)]
pub struct TriangleF64 {
    pub corners: [DVec3; 3],
    /// In scene order.
    pub index: u32,
    pub material: u32,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub struct HitF64<'a> {
    pub t: f64,
    /// Barycentric weights of the second and third corner.
    pub b: [f64; 2],
    pub triangle: &'a TriangleF64,
}

struct BoxNode {
    low: DVec3,
    high: DVec3,
    /// Triangles of a leaf; the children of any other node follow it and begin at `second`.
    range: std::ops::Range<usize>,
    second: Option<usize>,
}

impl TriangleSet {
    /// Takes the triangles as the GPU gets them, so that both see the same geometry.
    pub fn new(triangles: &[Triangle]) -> Self {
        let triangles = triangles
            .iter()
            .map(|t| TriangleF64 {
                corners: [t.a.as_dvec3(), t.b.as_dvec3(), t.c.as_dvec3()],
                index: t.index,
                material: t.material,
            })
            .collect::<Vec<_>>();
        let mut set = Self { nodes: Vec::new(), triangles };
        if !set.triangles.is_empty() {
            set.split(0..set.triangles.len());
        }
        set
    }

    fn split(&mut self, range: std::ops::Range<usize>) {
        let corners = || self.triangles[range.clone()].iter().flat_map(|t| t.corners);
        let low = corners().fold(DVec3::MAX, DVec3::min);
        let high = corners().fold(DVec3::MIN, DVec3::max);
        let node = self.nodes.len();
        self.nodes.push(BoxNode { low, high, range: range.clone(), second: None });
        if range.len() <= LEAF_SIZE {
            return;
        }
        let axis = (high - low).max_position();
        let centre = |t: &TriangleF64| t.corners.iter().map(|c| c[axis]).sum::<f64>();
        self.triangles[range.clone()].sort_by(|a, b| centre(a).total_cmp(&centre(b)));
        let middle = range.start + range.len() / 2;
        self.split(range.start..middle);
        self.nodes[node].second = Some(self.nodes.len());
        self.split(middle..range.end);
    }

    /// The hit of least (t, triangle) of those with t above `t_min`.
    pub fn closest(&self, origin: DVec3, direction: DVec3, t_min: f64) -> Option<HitF64<'_>> {
        self.closest_of(origin, direction, t_min, |_| true)
    }

    /// The same of those hits that are there.
    pub fn closest_of(
        &self,
        origin: DVec3,
        direction: DVec3,
        t_min: f64,
        is_there: impl Fn(&HitF64) -> bool,
    ) -> Option<HitF64<'_>> {
        let mut best: Option<HitF64> = None;
        let mut stack = vec![0; usize::from(!self.nodes.is_empty())];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            if !node.meets(origin, direction, best.map_or(f64::MAX, |hit| hit.t)) {
                continue;
            }
            if let Some(second) = node.second {
                stack.extend([second, index + 1]);
                continue;
            }
            for triangle in &self.triangles[node.range.clone()] {
                if let Some(hit) = intersect(triangle, origin, direction)
                    && hit.t > t_min
                    && best.is_none_or(|old| (hit.t, hit.triangle.index) < (old.t, old.triangle.index))
                    && is_there(&hit)
                {
                    best = Some(hit);
                }
            }
        }
        best
    }

    /// Where a ray meets the plane of a triangle of scene order, within it or not; none if it never does. It looks for the triangle.
    pub fn plane_of(&self, index: u32, origin: DVec3, direction: DVec3) -> Option<HitF64<'_>> {
        meet(self.triangles.iter().find(|triangle| triangle.index == index)?, origin, direction)
    }
}

impl BoxNode {
    fn meets(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        let (a, b) = ((self.low - origin) / direction, (self.high - origin) / direction);
        // min and max of f64 drop the NaN of a ray within a slab's plane.
        let (mut near, mut far) = (0.0f64, t_max);
        for axis in 0..3 {
            near = near.max(a[axis].min(b[axis]));
            far = far.min(a[axis].max(b[axis]));
        }
        near <= far * (1.0 + 1e-12) + 1e-12
    }
}

/// Where a ray meets a triangle.
fn intersect<'a>(triangle: &'a TriangleF64, origin: DVec3, direction: DVec3) -> Option<HitF64<'a>> {
    meet(triangle, origin, direction).filter(|HitF64 { b: [u, v], .. }| *u >= 0.0 && *v >= 0.0 && u + v <= 1.0)
}

/// Where a ray meets a triangle's plane (Moeller and Trumbore 1997).
fn meet<'a>(triangle: &'a TriangleF64, origin: DVec3, direction: DVec3) -> Option<HitF64<'a>> {
    let [a, b, c] = triangle.corners;
    let (e, f) = (b - a, c - a);
    let p = direction.cross(f);
    let det = e.dot(p);
    if det == 0.0 {
        return None;
    }
    let to_origin = origin - a;
    let u = to_origin.dot(p) / det;
    let q = to_origin.cross(e);
    let v = direction.dot(q) / det;
    Some(HitF64 { t: f.dot(q) / det, b: [u, v], triangle })
}
