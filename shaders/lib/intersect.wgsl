// Rays against boxes and triangles. Woop, Benthin, Wald: Watertight Ray/Triangle Intersection (2013).
//
// Every sum of a product is written as fma(), so that no two places where this is inlined can be contracted
// differently: the same ray and triangle give the same bits in every kernel of one device. (Not so with `halves`, of devices that round an fma()
// twice: those have nothing to contract it to.) NaN and infinity never arise
// from rays and triangles as package::gen describes them.

import package::gen::{FAR_GROWTH, INSET, LEAST_AREA, LEAST_PART, Ray, SLAB_GROWTH};
import package::lib::math::{largest_of};

// What a ray needs for every box and triangle, computed once.
struct Query {
    origin: vec3<f32>,
    t_min: f32,
    // Shear that turns the ray into the z axis, in permuted axes; z is t by depth in units of `unit`.
    shear: vec3<f32>,
    t_max: f32,
    // Plane p along an axis is met at p * inverse + low if it bounds a box from below, + high from above. The box is
    // grown by the two.
    inverse: vec3<f32>,
    // The axis along which the direction is largest.
    axis: u32,
    low: vec3<f32>,
    high: vec3<f32>,
    // A power of two by which ray and scene come to about 1, so that products neither underflow nor depend on the scale.
    unit: f32,
    // What decides whether surfaces with holes are there.
    chance: u32,
}

struct TriangleHit {
    // Clamped into the slabs of the triangle's own box; not yet compared with the ray's ends.
    t: f32,
    // Weights of the second and third corner.
    b1: f32,
    b2: f32,
    hit: bool,
}

// The coordinates in an order that puts `axis` last and keeps the handedness.
fn permute(v: vec3<f32>, axis: u32) -> vec3<f32> {
    return select(select(v.zxy, v.yzx, axis == 0u), v, axis == 2u);
}

// 1 / x, rounded right where fma() rounds once: WGSL allows a division 2.5 ulp, which differ from device to device.
fn reciprocal(x: f32) -> f32 {
    let r = 1.0 / x;
    return fma(r, fma(-x, r, 1.0), r);
}

fn largest_axis(d: vec3<f32>) -> u32 {
    let m = abs(d);
    return select(select(1u, 0u, m.x >= m.y), 2u, m.z >= max(m.x, m.y));
}

// A triangle's box, grown by what its own coordinates need: what all boxes of the tree are joined from.
struct PaddedBox {
    low: vec3<f32>,
    high: vec3<f32>,
}

fn padded_box(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> PaddedBox {
    let low = min(min(a, b), c);
    let high = max(max(a, b), c);
    // Exact, so that it makes no difference whether a device fuses it with the sums.
    let growth = vec3(SLAB_GROWTH * largest_of(max(-low, high)));
    return PaddedBox(low - growth, high + growth);
}

// `extent` is the greatest coordinate of the scene's box. The direction is not zero.
fn prepare_query(ray: Ray, extent: f32, chance: u32) -> Query {
    let axis = largest_axis(ray.direction);
    let d = permute(ray.direction, axis);
    let least = abs(d.z) * LEAST_PART;
    let signed_least = select(vec3(-least), vec3(least), ray.direction >= vec3(0.0));
    let safe = select(ray.direction, signed_least, abs(ray.direction) < vec3(least));
    let inverse = vec3(reciprocal(safe.x), reciprocal(safe.y), reciprocal(safe.z));
    let along = reciprocal(d.z);
    let far = largest_of(abs(ray.origin));
    let reach = vec3(far);
    let exponent = clamp(bitcast<u32>(far + extent) >> 23u, 27u, 227u);
    return Query(
        ray.origin,
        ray.t_min,
        vec3(d.xy * along, along * bitcast<f32>(exponent << 23u)),
        ray.t_max,
        inverse,
        axis,
        -(fma(vec3(SLAB_GROWTH), reach, ray.origin) * inverse),
        -(fma(vec3(-SLAB_GROWTH), reach, ray.origin) * inverse),
        bitcast<f32>((254u - exponent) << 23u),
        chance,
    );
}

// Where the ray is inside the grown box: from x to y, empty if x > y. Rounding is monotone in every step, so the
// interval of a box that encloses another encloses the other's interval.
fn slab_interval(query: Query, low: vec3<f32>, high: vec3<f32>) -> vec2<f32> {
    let a = fma(low, query.inverse, query.low);
    let b = fma(high, query.inverse, query.high);
    let near = min(a, b);
    let far = max(a, b);
    return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z) * FAR_GROWTH);
}

// a * b - c * d to 1.5 ulp, so with the right sign, or 0. Where fma() rounds once: Kahan; Jeannerod et al. 2013.
@if(!halves)
fn difference_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    let cd = c * d;
    let error = fma(-c, d, cd);
    return fma(a, b, -cd) + error;
}

// Where it rounds twice: the difference of the rounded products, and that of what they lack.
@if(halves)
fn difference_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    let ab = a * b;
    let cd = c * d;
    return as_written(ab - cd) + (product_error(a, b, ab) - product_error(c, d, cd));
}

// a * b less `product`, which is that rounded; exact, for each product of halves is, and so is each sum (Dekker 1971).
@if(halves)
fn product_error(a: f32, b: f32, product: f32) -> f32 {
    let a_high = upper_half(a);
    let b_high = upper_half(b);
    let a_low = a - a_high;
    let b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

// The first 12 of the 24 bits of x.
@if(halves)
fn upper_half(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

// A finite x, of which a compiler can't tell that it is a sum: Mesa takes the sum of two products and a third term in another order, for the sake
// of fused instructions, also where there are none.
@if(halves)
fn as_written(x: f32) -> f32 {
    return bitcast<f32>(min(bitcast<u32>(x), 0xff7fffffu));
}

// Twice the signed area of (0, p, q). Computed in one order of its ends, so that the two triangles of an edge get the
// same bits with opposite signs.
fn edge_function(p: vec2<f32>, q: vec2<f32>) -> f32 {
    let swapped = p.x > q.x || (p.x == q.x && p.y > q.y);
    let first = select(p, q, swapped);
    let second = select(q, p, swapped);
    let e = difference_of_products(first.x, second.y, first.y, second.x);
    return select(e, -e, swapped);
}

// The normal of a triangle by its winding, twice its area long.
fn triangle_normal(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let e = b - a;
    let f = c - a;
    return vec3(
        difference_of_products(e.y, f.z, e.z, f.y),
        difference_of_products(e.z, f.x, e.x, f.z),
        difference_of_products(e.x, f.y, e.y, f.x),
    );
}

// A corner relative to the ray: the ray is x = y = 0, and z grows along it.
fn shear_corner(query: Query, corner: vec3<f32>) -> vec3<f32> {
    let p = permute((corner - query.origin) * query.unit, query.axis);
    return vec3(fma(-query.shear.xy, p.zz, p.xy), p.z);
}

// Both sides count, edges and corners belong to every triangle they bound, and a triangle without area is never hit. `own` is its
// padded_box().
fn intersect_triangle(query: Query, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, own: PaddedBox) -> TriangleHit {
    let p = shear_corner(query, a);
    let q = shear_corner(query, b);
    let r = shear_corner(query, c);
    let u = edge_function(q.xy, r.xy);
    let v = edge_function(r.xy, p.xy);
    let w = edge_function(p.xy, q.xy);
    let det = u + v + w;
    var result = TriangleHit(0.0, 0.0, 0.0, false);
    if (min(min(u, v), w) < 0.0 && max(max(u, v), w) > 0.0) || abs(det) < LEAST_AREA {
        return result;
    }
    let interval = slab_interval(query, own.low, own.high);
    let area_normal = triangle_normal(a * query.unit, b * query.unit, c * query.unit);
    if interval.x > interval.y || all(area_normal == vec3(0.0)) {
        return result;
    }
    let scale = reciprocal(det);
    let depth = fma(u, p.z, fma(v, q.z, w * r.z)) * query.shear.z * scale;
    result.t = min(max(depth, interval.x), interval.y);
    result.b1 = v * scale;
    result.b2 = w * scale;
    result.hit = true;
    return result;
}

struct SurfacePoint {
    position: vec3<f32>,
    // How far each coordinate must be moved for a ray that leaves from here.
    error: vec3<f32>,
}

// The point of a triangle with weights b1 and b2 of its second and third corner. Its error bound is the sum of two:
// gamma(7) times the sum of absolute terms for the position (Pharr, Jakob, Humphreys: PBRT, 4th ed., section 6.8.5);
// and 8 * 2^-24 times the weighted distance of the corners, in every coordinate, for what the leaving ray's own test of
// this triangle rounds. In a plane through the scene's origin the first is 0 along the normal, the second never.
fn surface_point(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, b1: f32, b2: f32) -> SurfacePoint {
    let b0 = 1.0 - b1 - b2;
    let position = b0 * a + b1 * b + b2 * c;
    let rounding = 4.17232569e-7 * (abs(b0 * a) + abs(b1 * b) + abs(b2 * c));
    let corners = vec3(distance(a, position), distance(b, position), distance(c, position));
    let reach = abs(b0) * corners.x + b1 * corners.y + b2 * corners.z;
    let error = rounding + vec3(4.76837158203125e-7 * reach);
    let margin = INSET * largest_of(error);
    // No height of the triangle is less than its normal's length by its longest edge, and that at most twice the way to a corner.
    if (min(min(b0, b1), b2) * length(triangle_normal(a, b, c)) > 2.0 * margin * largest_of(corners)) {
        return SurfacePoint(position, error);
    }
    return SurfacePoint(inset(position, margin, a, b, c), error);
}

// A point of a triangle moved away from the edges that are nearer than `margin`, to that distance. A point that lies on an edge but for
// rounding may lie behind whatever shares the edge: the next wall of a closed room, from where a ray leaves it. In a corner of less
// than 90 degrees the offset along the normal, of an error or so, comes closer to the other wall again: INSET of them are enough
// down to 7 degrees.
fn inset(point: vec3<f32>, margin: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let area_normal = triangle_normal(a, b, c);
    let up = normalize(area_normal / largest_of(abs(area_normal)));
    return point + push(point - a, b - a, up, margin) + push(point - b, c - b, up, margin) + push(point - c, a - c, up, margin);
}

// What moves a point, given from one end of an edge, to `margin` from the edge on the triangle's side of it.
fn push(point: vec3<f32>, edge: vec3<f32>, up: vec3<f32>, margin: f32) -> vec3<f32> {
    let inwards = cross(up, normalize(edge / largest_of(abs(edge))));
    return max(margin - dot(point, inwards), 0.0) * inwards;
}

// The least float above a finite x if `up`, else the greatest below.
fn next_float(x: f32, up: bool) -> f32 {
    let bits = bitcast<u32>(x);
    let grows = (x > 0.0) == up;
    let step = select(bits - 1u, bits + 1u, grows);
    let smallest = select(0x80800000u, 0x00800000u, up);
    return bitcast<f32>(select(step, smallest, x == 0.0));
}

// `p` moved off its surface to the side of `w`, along the unit normal `n`, just so far that the true point cannot lie
// on the other side (PBRT, 4th ed., section 6.8.6).
fn offset_ray_origin(p: vec3<f32>, error: vec3<f32>, n: vec3<f32>, w: vec3<f32>) -> vec3<f32> {
    let d = dot(abs(n), error);
    let offset = select(-d, d, dot(w, n) >= 0.0) * n;
    let moved = p + offset;
    return vec3(
        select(moved.x, next_float(moved.x, offset.x > 0.0), offset.x != 0.0),
        select(moved.y, next_float(moved.y, offset.y > 0.0), offset.y != 0.0),
        select(moved.z, next_float(moved.z, offset.z > 0.0), offset.z != 0.0),
    );
}
