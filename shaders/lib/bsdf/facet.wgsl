// What a smooth shading normal is on: a flat facet. A BSDF about a normal that leans off the facet's own has directions on the wrong side of
// it. No light is lost there:
//
// - Mirrors, glass and the lobes around mirror directions: the facet mirrors what runs into it. That is the path's second bounce, off the
//   facet, without tracing it (as off the tangent facets of Schuessler et al., "Microfacet-based Normal Mapping for Robust Monte Carlo Path
//   Tracing", 2017). A direction that is left has up to two origins, whose densities add up.
// - The diffuse lobe, whose mirrored part would show as a bright edge where light grazes: what is above the facet is scaled up.
//
// All vectors are unit length; `facet` is the facet's normal on the side of the viewer.

import package::lib::bsdf::mirror::{reflected};

// The direction of which the facet is the mirror.
fn mirrored(wi: vec3<f32>, facet: vec3<f32>) -> vec3<f32> {
    return -reflected(wi, facet);
}

// A direction that leaves the facet on the viewer's side: `wi`, or where it runs into the facet, what becomes of it.
fn kept_above(wi: vec3<f32>, facet: vec3<f32>) -> vec3<f32> {
    return select(wi, mirrored(wi, facet), dot(wi, facet) < 0.0);
}

// What the cosine lobe about `n` is scaled by, that as much is above the facet as there is in all. Seen along `n` the lobe is a disc of
// even density, of which the facet leaves half a disc and half an ellipse that is foreshortened by the cosine between the normals.
fn crowding(n: vec3<f32>, facet: vec3<f32>) -> f32 {
    return 2.0 / (1.0 + dot(n, facet));
}

// A direction of the cosine lobe about `n`, moved to one above the facet, so that the density is that of the lobe times crowding(): every
// chord of the disc along the lean is shortened from its far end.
fn crowded(wi: vec3<f32>, n: vec3<f32>, facet: vec3<f32>) -> vec3<f32> {
    let c = dot(n, facet);
    let lean = facet - c * n;
    let square = dot(lean, lean);
    // Leaning by less, a direction moves by less than its rounding.
    if (square < 1e-8) {
        return wi;
    }
    let e = lean * inverseSqrt(square);
    let y = dot(wi, e);
    let z = dot(wi, n);
    let half_chord = sqrt(y * y + z * z);
    let to_end = 0.5 * (1.0 + c) * (half_chord - y);
    let height = sqrt(to_end * (2.0 * half_chord - to_end));
    return normalize(wi + (half_chord - to_end - y) * e + (height - z) * n);
}

// The cosine to `n` of the direction that crowded() moves to `wi`.
@if(coat)
fn cos_before_crowding(wi: vec3<f32>, n: vec3<f32>, facet: vec3<f32>) -> f32 {
    let c = dot(n, facet);
    let lean = facet - c * n;
    let square = dot(lean, lean);
    let z = dot(wi, n);
    if (square < 1e-8) {
        return z;
    }
    let y = dot(wi, lean) * inverseSqrt(square);
    let half_chord = sqrt(y * y + z * z);
    let to_end = clamp(2.0 / (1.0 + c) * (half_chord - y), 0.0, 2.0 * half_chord);
    return sqrt(to_end * (2.0 * half_chord - to_end));
}
