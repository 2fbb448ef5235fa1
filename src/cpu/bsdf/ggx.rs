//! Rough conductor: facets by GGX (Walter et al. 2007) with Smith's height-correlated masking and shadowing (Heitz 2014), as
//! their papers write them. The kernel's forms are others, made for f32.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::directions::{frame, mirror};

/// Density of facets by the cosine of their normal to the surface's; 0 below the horizon.
pub fn density(alpha: f64, cos: f64) -> f64 {
    let a2 = alpha * alpha;
    if cos > 0.0 { a2 / (PI * (cos * cos * (a2 - 1.0) + 1.0).powi(2)) } else { 0.0 }
}

/// Smith's Lambda of a direction by its cosine to the normal.
pub fn lambda(alpha: f64, cos: f64) -> f64 {
    let tan2 = (1.0 - cos * cos).max(0.0) / (cos * cos);
    0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
}

/// f cos for ks = 1: 0 unless both directions are above the surface.
pub fn value(alpha: f64, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
    let (cos_o, cos_i) = (n.dot(wo), n.dot(wi));
    if cos_o <= 0.0 || cos_i <= 0.0 {
        return 0.0;
    }
    let g2 = 1.0 / (1.0 + lambda(alpha, cos_o) + lambda(alpha, cos_i));
    density(alpha, n.dot((wo + wi).normalize())) * g2 / (4.0 * cos_o)
}

/// By which [`sample`] draws `wi`, above the surface or not.
pub fn pdf(alpha: f64, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
    let cos_o = n.dot(wo);
    let g1 = 1.0 / (1.0 + lambda(alpha, cos_o));
    density(alpha, n.dot((wo + wi).normalize_or_zero())) * g1 / (4.0 * cos_o)
}

/// A direction by visible normals (Dupuy and Benyoub 2023).
pub fn sample(alpha: f64, n: DVec3, wo: DVec3, u: DVec2) -> DVec3 {
    let (t, b) = frame(n);
    let stretched = DVec3::new(alpha * wo.dot(t), alpha * wo.dot(b), wo.dot(n)).normalize();
    let z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
    let sin = (1.0 - z * z).max(0.0).sqrt();
    let (sin_turn, cos_turn) = (u.y * TAU).sin_cos();
    let facet = DVec3::new(sin * cos_turn, sin * sin_turn, z) + stretched;
    let h = (t * (alpha * facet.x) + b * (alpha * facet.y) + n * facet.z).normalize();
    mirror(h, wo)
}
