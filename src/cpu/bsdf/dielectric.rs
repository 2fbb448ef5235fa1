//! Smooth dielectric: Snell's law and Fresnel's equations as textbooks write them.

use glam::DVec3;

/// Indices of refraction on the viewer's side of a surface and beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    pub here: f64,
    pub beyond: f64,
}

impl Interface {
    /// Of a material of index `ni`, seen from outside or, from behind, from within.
    pub fn new(ni: f64, back_face: bool) -> Self {
        if back_face { Self { here: ni, beyond: 1.0 } } else { Self { here: 1.0, beyond: ni } }
    }

    /// Cosine of the refracted direction to the normal on its side; none under total reflection.
    pub fn cos_transmitted(&self, cos: f64) -> Option<f64> {
        let sin2 = (self.here / self.beyond).powi(2) * (1.0 - cos * cos);
        (sin2 < 1.0).then(|| (1.0 - sin2).sqrt())
    }

    /// Part of unpolarised light that is reflected.
    pub fn reflectance(&self, cos: f64) -> f64 {
        let Some(cos_t) = self.cos_transmitted(cos) else { return 1.0 };
        let amplitude = |a: f64, b: f64| (a - b) / (a + b);
        let s = amplitude(self.here * cos, self.beyond * cos_t);
        let p = amplitude(self.beyond * cos, self.here * cos_t);
        0.5 * (s * s + p * p)
    }

    /// The direction beyond the surface of normal `n`, which is on the side of `wo`; none under total reflection.
    pub fn refracted(&self, n: DVec3, wo: DVec3) -> Option<DVec3> {
        let cos_t = self.cos_transmitted(n.dot(wo))?;
        let along = (n * n.dot(wo) - wo) * (self.here / self.beyond);
        Some((along - n * cos_t).normalize())
    }

    /// What radiance is multiplied by on its way through: it is squeezed into another cone.
    pub fn eta_squared(&self) -> f64 {
        (self.here / self.beyond).powi(2)
    }
}
