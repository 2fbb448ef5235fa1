//! Directions about a normal, and those that lobes draw.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

/// `wo` reflected about `n`.
pub fn mirror(n: DVec3, wo: DVec3) -> DVec3 {
    2.0 * wo.dot(n) * n - wo
}

/// cos(alpha)^n, 0 from 90 degrees on.
pub fn cos_power(a: DVec3, b: DVec3, n: f64) -> f64 {
    let one_minus_cos = 0.5 * (a - b).length_squared();
    if one_minus_cos < 1.0 { (n * (-one_minus_cos).ln_1p()).exp() } else { 0.0 }
}

/// Cosine-weighted about `n`.
pub fn sample_cosine(n: DVec3, u: DVec2) -> DVec3 {
    around(n, u.y, u.x.sqrt(), (1.0 - u.x).sqrt())
}

/// Phong lobe about `r`: cos(alpha) = (1 - u)^(1 / (n + 1)).
pub fn sample_phong(r: DVec3, n: f64, u: DVec2) -> DVec3 {
    let one_minus_cos = -((-u.x).ln_1p() / (n + 1.0)).exp_m1();
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    around(r, u.y, sin, 1.0 - one_minus_cos)
}

/// The direction at `turn` turns about unit `n`.
fn around(n: DVec3, turn: f64, sin: f64, cos: f64) -> DVec3 {
    let (t, b) = frame(n);
    let (sin_turn, cos_turn) = (turn * TAU).sin_cos();
    (t * (sin * cos_turn) + b * (sin * sin_turn) + n * cos).normalize()
}

/// Two unit vectors that make a right-handed frame with unit `n` (Duff et al., JCGT 6(1), 2017).
pub fn frame(n: DVec3) -> (DVec3, DVec3) {
    let s = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    (DVec3::new(1.0 + s * n.x * n.x * a, s * b, -s * n.x), DVec3::new(b, s + n.y * n.y * a, -n.y))
}
