//! Clear coat: what it reflects, and what it leaves of the base. The model is that of `lib/bsdf/coat`: Kelemen and Szirmay-Kalos 2001 over
//! the diffuse lobe, the lesser of both ways through over the specular one.

use glam::DVec3;

use super::dielectric::Interface;
use super::ggx;

/// Index of refraction.
pub const INDEX: f64 = 1.5;

/// By powers of y, and in each row of the roughness: what roughness makes of Fresnel's reflectance, a little too much.
const GAIN: [[f64; 6]; 5] = [
    [1.0634, -2.0963, -2.8126, 13.4761, -15.1459, 5.6163],
    [-1.6539, 13.587, -33.0034, 36.1644, -18.4744, 3.355],
    [5.5267, -33.0106, 79.4709, -100.0, 65.7553, -16.7408],
    [-6.4803, 33.037, -22.3044, -42.3632, 63.5393, -26.0373],
    [2.5601, -11.789, -19.9363, 91.8712, -100.0, 37.1859],
];

/// By powers of the roughness: the mean of what a rough coat reflects, a little too little.
const MEAN: [f64; 7] = [0.09265, -0.01885, 0.21597, -1.87831, 4.02832, -3.6083, 1.19101];

/// The mean of what a smooth coat reflects.
pub const SMOOTH_MEAN: f64 = 0.09177795934235122;

/// A coat by its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// Part of the surface that has one, 0 to 1.
    pub amount: f64,
    /// None: a mirror.
    pub alpha: Option<f64>,
}

impl Coat {
    fn fresnel(cos: f64) -> f64 {
        Interface::new(INDEX, false).reflectance(cos)
    }

    /// The part of the light from a direction that it reflects.
    pub fn reflectance(&self, cos: f64) -> f64 {
        let gain = self.alpha.map_or(1.0, |alpha| {
            let y = cos * (1.0 + 4.0 * alpha) / (cos + 4.0 * alpha);
            polynomial(y, &GAIN.map(|row| polynomial(alpha.sqrt(), &row)))
        });
        // The fit is above 1 where light grazes.
        self.amount * (gain * Self::fresnel(cos)).min(1.0)
    }

    /// The mean of that over all directions, by their cosine.
    pub fn mean_reflectance(&self) -> f64 {
        self.amount * self.alpha.map_or(SMOOTH_MEAN, |alpha| polynomial(alpha.sqrt(), &MEAN))
    }

    /// What it leaves of the diffuse lobe.
    pub fn over_diffuse(&self, cos_o: f64, cos_i: f64) -> f64 {
        (1.0 - self.reflectance(cos_o)) * (1.0 - self.reflectance(cos_i)) / (1.0 - self.mean_reflectance())
    }

    /// What it leaves of the specular lobe.
    pub fn over_specular(&self, cos_o: f64, cos_i: f64) -> f64 {
        (1.0 - self.reflectance(cos_o)).min(1.0 - self.reflectance(cos_i))
    }

    /// Probability of sampling it over a base of this luminance: by what each sends back.
    pub fn share(&self, cos_o: f64, base: f64) -> f64 {
        let reflected = self.reflectance(cos_o);
        if reflected > 0.0 { reflected / (reflected + (1.0 - reflected) * base) } else { 0.0 }
    }

    /// f cos and pdf of a rough one; a mirror has neither.
    pub fn lobe(&self, n: DVec3, wo: DVec3, wi: DVec3) -> (f64, f64) {
        let Some(alpha) = self.alpha else { return (0.0, 0.0) };
        let cos = wo.dot((wo + wi).normalize_or_zero());
        (self.amount * Self::fresnel(cos) * ggx::value(alpha, n, wo, wi), ggx::pdf(alpha, n, wo, wi))
    }
}

/// Least power first.
fn polynomial(x: f64, terms: &[f64]) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * x + term)
}
