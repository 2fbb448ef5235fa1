//! Twin of `shaders/lib/intersect.wgsl`: the same functions, in f32, step by step.

use glam::{Vec2, Vec3, Vec3Swizzles};

use super::bounds::{Bounds, padded_box};
use crate::layout::ray::{FAR_GROWTH, INSET, LEAST_AREA, LEAST_PART, Ray, SLAB_GROWTH};

/// How a device rounds WGSL's `fma()`, which may be either.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fma {
    /// Once, as a fused instruction does.
    Fused,
    /// The product and then the sum, as lavapipe does: then products are made exact from halves (feature `halves`).
    Unfused,
}

impl Fma {
    /// a * b + c.
    pub fn of(self, a: f32, b: f32, c: f32) -> f32 {
        match self {
            Fma::Fused => a.mul_add(b, c),
            Fma::Unfused => a * b + c,
        }
    }

    /// 1 / x, rounded right if fused.
    pub fn reciprocal(self, x: f32) -> f32 {
        let r = 1.0 / x;
        self.of(r, self.of(-x, r, 1.0), r)
    }

    fn of_vectors(self, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
        Vec3::new(self.of(a.x, b.x, c.x), self.of(a.y, b.y, c.y), self.of(a.z, b.z, c.z))
    }
}

/// What a ray needs for every box and triangle.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The arithmetic of all that follows.
    pub fma: Fma,
    pub origin: Vec3,
    pub t_min: f32,
    /// Shear that turns the ray into the z axis, in permuted axes; z is t by depth in units of `unit`.
    pub shear: Vec3,
    pub t_max: f32,
    /// Plane p along an axis is met at `p * inverse + low` if it bounds a box from below, `+ high` from above.
    pub inverse: Vec3,
    /// The axis along which the direction is largest.
    pub axis: usize,
    pub low: Vec3,
    pub high: Vec3,
    /// A power of two by which ray and scene come to about 1.
    pub unit: f32,
}

/// A triangle's hit, not yet compared with the ray's ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Clamped into the slabs of the triangle's own box.
    pub t: f32,
    /// Weight of the second corner.
    pub b1: f32,
    /// Weight of the third corner.
    pub b2: f32,
}

/// The coordinates in an order that puts `axis` last and keeps the handedness.
pub fn permute(v: Vec3, axis: usize) -> Vec3 {
    match axis {
        0 => v.yzx(),
        1 => v.zxy(),
        _ => v,
    }
}

/// The axis of the greatest absolute coordinate; z before x before y where they are equal.
pub fn largest_axis(d: Vec3) -> usize {
    let m = d.abs();
    if m.z >= m.x.max(m.y) {
        2
    } else if m.x >= m.y {
        0
    } else {
        1
    }
}

/// `extent` is the greatest coordinate of the scene's box. The direction is not zero.
pub fn prepare_query(fma: Fma, ray: &Ray, extent: f32) -> Query {
    let axis = largest_axis(ray.direction);
    let d = permute(ray.direction, axis);
    let least = d.z.abs() * LEAST_PART;
    let safe = |d: f32| match (d.abs() < least, d >= 0.0) {
        (false, _) => d,
        (true, true) => least,
        (true, false) => -least,
    };
    let inverse = Vec3::from_array(ray.direction.to_array().map(|d| fma.reciprocal(safe(d))));
    let along = fma.reciprocal(d.z);
    let far = ray.origin.abs().max_element();
    let reach = Vec3::splat(far);
    let exponent = ((far + extent).to_bits() >> 23).clamp(27, 227);
    Query {
        fma,
        origin: ray.origin,
        t_min: ray.t_min,
        shear: Vec3::new(d.x * along, d.y * along, along * f32::from_bits(exponent << 23)),
        t_max: ray.t_max,
        inverse,
        axis,
        low: -(fma.of_vectors(Vec3::splat(SLAB_GROWTH), reach, ray.origin) * inverse),
        high: -(fma.of_vectors(Vec3::splat(-SLAB_GROWTH), reach, ray.origin) * inverse),
        unit: f32::from_bits((254 - exponent) << 23),
    }
}

/// Where the ray is inside the grown box: from x to y, empty if x > y.
pub fn slab_interval(query: &Query, bounds: Bounds) -> Vec2 {
    let a = query.fma.of_vectors(bounds.low, query.inverse, query.low);
    let b = query.fma.of_vectors(bounds.high, query.inverse, query.high);
    Vec2::new(a.min(b).max_element(), a.max(b).min_element() * FAR_GROWTH)
}

/// `a * b - c * d` to 1.5 ulp, so with the right sign, or 0 (fused: Kahan).
pub fn difference_of_products(fma: Fma, a: f32, b: f32, c: f32, d: f32) -> f32 {
    let cd = c * d;
    match fma {
        Fma::Fused => a.mul_add(b, -cd) + (-c).mul_add(d, cd),
        Fma::Unfused => {
            let ab = a * b;
            (ab - cd) + (product_error(a, b, ab) - product_error(c, d, cd))
        }
    }
}

/// `a * b` less `product`, which is that rounded; exact (Dekker 1971).
fn product_error(a: f32, b: f32, product: f32) -> f32 {
    let [a_high, b_high] = [a, b].map(|x| f32::from_bits(x.to_bits() & 0xffff_f000));
    let (a_low, b_low) = (a - a_high, b - b_high);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// Twice the signed area of (0, p, q), the negative of that of (0, q, p) to the bit.
pub fn edge_function(fma: Fma, p: Vec2, q: Vec2) -> f32 {
    if p.x > q.x || (p.x == q.x && p.y > q.y) {
        -difference_of_products(fma, q.x, p.y, q.y, p.x)
    } else {
        difference_of_products(fma, p.x, q.y, p.y, q.x)
    }
}

/// The normal of a triangle by its winding, twice its area long.
pub fn triangle_normal(fma: Fma, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let (e, f) = (b - a, c - a);
    Vec3::new(
        difference_of_products(fma, e.y, f.z, e.z, f.y),
        difference_of_products(fma, e.z, f.x, e.x, f.z),
        difference_of_products(fma, e.x, f.y, e.y, f.x),
    )
}

/// A corner relative to the ray: the ray is x = y = 0, and z grows along it.
pub fn shear_corner(query: &Query, corner: Vec3) -> Vec3 {
    let p = permute((corner - query.origin) * query.unit, query.axis);
    Vec3::new(query.fma.of(-query.shear.x, p.z, p.x), query.fma.of(-query.shear.y, p.z, p.y), p.z)
}

/// Both sides count, edges and corners belong to every triangle they bound, and a triangle without area is never hit.
pub fn intersect_triangle(query: &Query, a: Vec3, b: Vec3, c: Vec3) -> Option<TriangleHit> {
    let fma = query.fma;
    let [p, q, r] = [a, b, c].map(|corner| shear_corner(query, corner));
    let u = edge_function(fma, q.xy(), r.xy());
    let v = edge_function(fma, r.xy(), p.xy());
    let w = edge_function(fma, p.xy(), q.xy());
    let det = u + v + w;
    if (u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0) || det.abs() < LEAST_AREA {
        return None;
    }
    let interval = slab_interval(query, padded_box(a, b, c));
    let area_normal = triangle_normal(fma, a * query.unit, b * query.unit, c * query.unit);
    if interval.x > interval.y || area_normal == Vec3::ZERO {
        return None;
    }
    let scale = fma.reciprocal(det);
    let depth = fma.of(u, p.z, fma.of(v, q.z, w * r.z)) * query.shear.z * scale;
    Some(TriangleHit { t: depth.max(interval.x).min(interval.y), b1: v * scale, b2: w * scale })
}

/// A point of a triangle with weights `b1` and `b2` of its second and third corner, and how far each coordinate must be
/// moved for a ray that leaves from there: the position's own error (PBRT, 4th ed., section 6.8.5), and that of the
/// leaving ray's test of this triangle. Away from the edges, behind which there may be a wall.
pub fn surface_point(a: Vec3, b: Vec3, c: Vec3, b1: f32, b2: f32) -> (Vec3, Vec3) {
    let b0 = 1.0 - b1 - b2;
    let position = b0 * a + b1 * b + b2 * c;
    let rounding = 4.172_325_7e-7 * ((b0 * a).abs() + (b1 * b).abs() + (b2 * c).abs());
    let reach = b0.abs() * a.distance(position) + b1 * b.distance(position) + b2 * c.distance(position);
    let error = rounding + Vec3::splat(4.768_371_6e-7 * reach);
    (inset(position, INSET * error.max_element(), [a, b, c]), error)
}

/// A point of a triangle moved away from the edges that are nearer than `margin`, to that distance.
fn inset(point: Vec3, margin: f32, [a, b, c]: [Vec3; 3]) -> Vec3 {
    let area_normal = (b - a).cross(c - a);
    let up = (area_normal / area_normal.abs().max_element()).normalize();
    let push = |from: Vec3, to: Vec3| {
        let edge = to - from;
        let inwards = up.cross((edge / edge.abs().max_element()).normalize());
        (margin - (point - from).dot(inwards)).max(0.0) * inwards
    };
    point + push(a, b) + push(b, c) + push(c, a)
}

/// The least normal float above a finite `x` if `up`, else the greatest below.
fn next_float(x: f32, up: bool) -> f32 {
    match (x == 0.0, up) {
        (true, true) => f32::MIN_POSITIVE,
        (true, false) => -f32::MIN_POSITIVE,
        _ if (x > 0.0) == up => f32::from_bits(x.to_bits() + 1),
        _ => f32::from_bits(x.to_bits() - 1),
    }
}

/// `p` moved off its surface to the side of `w`, along the unit normal `n`, just so far that the true point cannot lie
/// on the other side (PBRT, 4th ed., section 6.8.6).
pub fn offset_ray_origin(p: Vec3, error: Vec3, n: Vec3, w: Vec3) -> Vec3 {
    let d = n.abs().dot(error);
    let offset = if w.dot(n) >= 0.0 { d } else { -d } * n;
    let mut moved = (p + offset).to_array();
    for (x, offset) in moved.iter_mut().zip(offset.to_array()) {
        if offset != 0.0 {
            *x = next_float(*x, offset > 0.0);
        }
    }
    Vec3::from_array(moved)
}
