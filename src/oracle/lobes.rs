//! Lobes by themselves: f cos for a reflectance of 1, densities, draws.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::facing::Facing;
use super::random::Random;

/// The direction at an angle of this cosine from unit `axis`, `turn` turns about it.
pub fn around(axis: DVec3, cos: f64, turn: f64) -> DVec3 {
    let (s, t) = axis.any_orthonormal_pair();
    let (sin_turn, cos_turn) = (TAU * turn).sin_cos();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    (sin * (cos_turn * s + sin_turn * t) + cos * axis).normalize()
}

/// By the cosine about the shading normal, of the directions above the true surface; at least every second one is.
pub fn draw_diffuse(facing: &Facing, random: &mut Random) -> Option<DVec3> {
    const TRIES: usize = 64;
    (0..TRIES)
        .map(|_| around(facing.shading, (1.0 - random.unit()).sqrt(), random.unit()))
        .find(|wi| wi.dot(facing.geometric) > 0.0)
}

/// f cos and pdf of the Phong lobe of reflectance 1.
pub fn phong(n: f64, facing: &Facing, wi: DVec3) -> (f64, f64) {
    let cos_alpha = facing.mirror().dot(wi);
    let lobe = if cos_alpha > 0.0 { cos_alpha.powf(n) / TAU } else { 0.0 };
    ((n + 2.0) * lobe * wi.dot(facing.shading), (n + 1.0) * lobe)
}

/// f cos and pdf of the GGX lobe of reflectance 1, drawn by the normals that `wo` sees.
pub fn ggx(alpha: f64, facing: &Facing, wi: DVec3) -> (f64, f64) {
    let to_local = facing.frame().transpose();
    let (o, i) = (to_local * facing.wo, to_local * wi);
    let tan2 = |w: DVec3| (w.x * w.x + w.y * w.y) / (w.z * w.z);
    let lambda = |w: DVec3| 0.5 * ((1.0 + alpha * alpha * tan2(w)).sqrt() - 1.0);
    let h = (o + i).normalize();
    let d = 1.0 / (PI * (alpha * h.z * h.z * (1.0 + tan2(h) / (alpha * alpha))).powi(2));
    let common = d / (4.0 * o.z);
    (common / (1.0 + lambda(o) + lambda(i)), common / (1.0 + lambda(o)))
}

/// Visible normals by spherical caps (Dupuy and Benyoub, 2023).
pub fn draw_ggx(alpha: f64, facing: &Facing, u: f64, v: f64) -> DVec3 {
    let frame = facing.frame();
    let o = frame.transpose() * facing.wo;
    let stretch = DVec3::new(alpha, alpha, 1.0);
    let seen = (o * stretch).normalize();
    let z = (1.0 - u) * (1.0 + seen.z) - seen.z;
    let cap = around(DVec3::Z, z.clamp(-1.0, 1.0), v);
    let h = ((cap + seen) * stretch).normalize();
    frame * (2.0 * o.dot(h) * h - o)
}

/// Unpolarised reflectance of a boundary, `ratio` being the index here by that beyond.
pub fn fresnel(ratio: f64, cos: f64, cos_beyond: f64) -> f64 {
    let parallel = (cos - ratio * cos_beyond) / (cos + ratio * cos_beyond);
    let perpendicular = (ratio * cos - cos_beyond) / (ratio * cos + cos_beyond);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
