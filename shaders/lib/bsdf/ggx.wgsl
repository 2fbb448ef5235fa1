// Rough conductor: facets distributed by GGX (Walter et al. 2007), Smith's height-correlated masking and shadowing (Heitz
// 2014), reflectance ks for every angle: f = ks D G2 / (4 cos_o cos_i). Directions are drawn by visible normals.

import package::lib::bsdf::mirror::{reflected};
import package::lib::math::{INV_PI, frame_around, sin_cos_turns};

struct GgxValue {
    // f * cos of the incident direction, for ks = 1.
    value: f32,
    pdf: f32,
}

// cos + sqrt(cos^2 + alpha^2 sin^2): 2 cos / G1. Without a cancellation, however small alpha is.
fn ggx_reach(alpha: f32, cos_theta: f32) -> f32 {
    let slope = alpha * alpha * max(0.0, 1.0 - cos_theta * cos_theta);
    return cos_theta + sqrt(cos_theta * cos_theta + slope);
}

// The density D of facets of unit normal `h`, above the horizon. The squared sine comes from the distance of the two points: for small
// alpha the cosine itself has lost what matters.
fn ggx_density(alpha: f32, n: vec3<f32>, h: vec3<f32>) -> f32 {
    let d = n - h;
    let square = dot(d, d);
    let sin2 = max(0.0, square * (1.0 - 0.25 * square));
    let cos_theta = 1.0 - 0.5 * square;
    let spread = alpha * cos_theta * alpha * cos_theta + sin2;
    let root = alpha / spread;
    return INV_PI * root * root;
}

// Both cosines are above 0.
fn ggx_evaluate(alpha: f32, n: vec3<f32>, wo: vec3<f32>, wi: vec3<f32>) -> GgxValue {
    let cos_o = dot(wo, n);
    let cos_i = dot(wi, n);
    let density = ggx_density(alpha, n, normalize(wo + wi));
    let reach_o = ggx_reach(alpha, cos_o);
    let reach_i = ggx_reach(alpha, cos_i);
    // G2 / (4 cos_o) is cos_i / (2 (cos_i S_o + cos_o S_i)), S being the square roots; G1 / (4 cos_o) is 1 / (2 reach_o).
    let both = cos_i * (reach_o - cos_o) + cos_o * (reach_i - cos_i);
    return GgxValue(0.5 * density * cos_i / both, 0.5 * density / reach_o);
}

// Visible normals as points of a spherical cap (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
// 2023); the direction is `wo` reflected about one. May be below the surface.
fn ggx_sample(alpha: f32, n: vec3<f32>, wo: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let frame = frame_around(n);
    let stretched =
        normalize(vec3<f32>(alpha * dot(wo, frame.t), alpha * dot(wo, frame.b), max(0.0, dot(wo, n))));
    // The cap's height is 1 at its pole and -stretched.z at its edge; 1 - z and 1 + z are formed apart, so that
    // neither cancels. 1 - u is at least 2^-24, so that the normal never lies in the surface.
    let reach = 1.0 + stretched.z;
    let below = u.x * reach;
    let rest = (1.0 - u.x) * reach;
    let shortfall = dot(stretched.xy, stretched.xy) / reach;
    let turn = sin_cos_turns(u.y) * sqrt(below * (rest + shortfall));
    let slope = alpha * (vec2<f32>(turn.y, turn.x) + stretched.xy);
    let h = normalize(frame.t * slope.x + frame.b * slope.y + n * rest);
    return reflected(wo, h);
}
