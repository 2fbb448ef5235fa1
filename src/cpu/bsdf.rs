//! BSDFs in f64: the oracle of `lib/bsdf` and `lib/sampling`. Directions are unit vectors that point away from the surface.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::layout::trace::MaterialRecord;

/// A material's numbers in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    pub kd: DVec3,
    pub ks: DVec3,
    /// Exponent of the Phong lobe.
    pub ns: f64,
    /// Probability of sampling the Phong lobe.
    pub glossy: f64,
}

/// A BSDF in one pair of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfValue {
    /// f times the cosine of the incident direction.
    pub value: DVec3,
    /// Of the whole mixture, by solid angle. Below the surface there is density, and nothing is carried.
    pub pdf: f64,
}

impl From<&MaterialRecord> for Reflection {
    fn from(record: &MaterialRecord) -> Self {
        let MaterialRecord { kd, ks, ns, glossy, .. } = *record;
        Self { kd: kd.as_dvec3(), ks: ks.as_dvec3(), ns: f64::from(ns), glossy: f64::from(glossy) }
    }
}

impl Reflection {
    /// f = kd / pi + ks (n + 2) / (2 pi) cos^n(alpha), times the cosine of `wi` about the shading normal `n`.
    pub fn evaluate(&self, n: DVec3, wo: DVec3, wi: DVec3) -> BsdfValue {
        let cos_theta = n.dot(wi);
        let lobe = cos_power(mirror(n, wo), wi, self.ns);
        let f = self.kd / PI + self.ks * ((self.ns + 2.0) / TAU * lobe);
        let diffuse = cos_theta.max(0.0) / PI;
        let glossy = (self.ns + 1.0) / TAU * lobe;
        BsdfValue {
            value: if cos_theta > 0.0 { f * cos_theta } else { DVec3::ZERO },
            pdf: (1.0 - self.glossy) * diffuse + self.glossy * glossy,
        }
    }

    /// A direction by the mixture's pdf: `pick` chooses the lobe, `u` the direction in it, all in [0, 1).
    pub fn sample(&self, n: DVec3, wo: DVec3, pick: f64, u: DVec2) -> DVec3 {
        match pick < self.glossy {
            true => sample_phong(mirror(n, wo), self.ns, u),
            false => sample_cosine(n, u),
        }
    }
}

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

/// The direction at `turn` turns about unit `n`, in the frame of Duff et al., JCGT 6(1), 2017.
fn around(n: DVec3, turn: f64, sin: f64, cos: f64) -> DVec3 {
    let s = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    let t = DVec3::new(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    let bitangent = DVec3::new(b, s + n.y * n.y * a, -n.y);
    let (sin_turn, cos_turn) = (turn * TAU).sin_cos();
    (t * (sin * cos_turn) + bitangent * (sin * sin_turn) + n * cos).normalize()
}
