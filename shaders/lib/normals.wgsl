// Smooth shading normals.

import package::gen::{LEAST_FACING, Shading};

// A unit vector from its octahedral snorm16 pair (Cigolle et al., JCGT 3(2), 2014).
fn octahedral_decode(word: u32) -> vec3<f32> {
    let e = vec2<f32>(vec2<i32>(bitcast<i32>(word << 16u), bitcast<i32>(word)) >> vec2<u32>(16u));
    let z = 32767.0 - abs(e.x) - abs(e.y);
    // Below the equator both coordinates are positive or negative, never 0.
    return normalize(vec3<f32>(e + sign(e) * min(z, 0.0), z));
}

// The normal at weights b1 and b2 of the second and third corner, on the side that the mesh says; `flat` where a corner has none or
// they cancel. Unit length.
fn interpolate_normal(corners: Shading, b1: f32, b2: f32, flat: vec3<f32>) -> vec3<f32> {
    if (corners.n0 == 0u || corners.n1 == 0u || corners.n2 == 0u) {
        return flat;
    }
    let n = (1.0 - b1 - b2) * octahedral_decode(corners.n0)
        + b1 * octahedral_decode(corners.n1)
        + b2 * octahedral_decode(corners.n2);
    if (dot(n, n) < 1e-6) {
        return flat;
    }
    return normalize(n);
}

// A vector on the side of another.
fn facing(n: vec3<f32>, side: vec3<f32>) -> vec3<f32> {
    return select(n, -n, dot(n, side) < 0.0);
}

// A shading normal that its viewer is not behind of: turned towards `wo`, as little as it takes, where the facet is seen and the normal
// looks away (a local fix like that of Keller et al., "The Iray Light Transport Simulation and Rendering System", 2017). There the normal is
// seen grazing, so that mirrors and glass go over to reflection by the facet itself without an edge (lib/bsdf/facet). Unit length.
fn bent_to_viewer(n: vec3<f32>, facet: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    let lack = min(LEAST_FACING, dot(wo, facet)) - dot(wo, n);
    return select(n, normalize(n + lack * wo), lack > 0.0);
}
