//! Clear coat: a boundary of index 1.5 over a surface, whose loss of light to the base is found by quadrature.
//!
//! The base has what the boundary lets in, and sends it out through the boundary. For a diffuse base that is the product of what passes both
//! ways, over what passes of all directions together (Kelemen and Szirmay-Kalos 2001); for a specular one, whose two directions are
//! alike, the less of the two.

use glam::DVec3;

use super::facing::Facing;
use super::lobes::{draw_ggx, fresnel, ggx};

const INDEX: f64 = 1.5;

/// Steps of the cosine's root, in which what is reflected is tabled.
const STEPS: usize = 256;

/// Draws of a facet for each of them, along both axes of the unit square.
const DRAWS: [usize; 2] = [96, 48];

#[derive(Clone, Debug)]
pub struct Coat {
    amount: f64,
    /// None is a mirror.
    alpha: Option<f64>,
    /// What a coat of amount 1 reflects by the root of the cosine: of a rough one.
    table: Vec<f64>,
    /// The mean of what this one reflects, by the cosine.
    mean: f64,
}

impl Coat {
    /// None where there is none.
    pub fn new(amount: f64, alpha: Option<f64>) -> Option<Self> {
        if amount <= 0.0 {
            return None;
        }
        let table = alpha.map_or_else(Vec::new, |alpha| (0..=STEPS).map(|i| albedo(alpha, cosine(i as f64))).collect());
        let mut coat = Self { amount, alpha, table, mean: 0.0 };
        // 2 c dc by the root s of c: 4 s^3 ds.
        let parts = (0..8 * STEPS).map(|i| {
            let s = (i as f64 + 0.5) / (8 * STEPS) as f64;
            4.0 * s.powi(3) * coat.reflected(s * s)
        });
        coat.mean = parts.sum::<f64>() / (8 * STEPS) as f64;
        Some(coat)
    }

    pub fn alpha(&self) -> Option<f64> {
        self.alpha
    }

    /// Part of what comes from a direction of this cosine.
    pub fn reflected(&self, cos: f64) -> f64 {
        let Some(last) = self.table.len().checked_sub(2) else { return self.amount * boundary(cos) };
        let at = cos.clamp(0.0, 1.0).sqrt() * STEPS as f64;
        let i = (at as usize).min(last);
        let part = at - i as f64;
        self.amount * ((1.0 - part) * self.table[i] + part * self.table[i + 1])
    }

    /// What is left of a diffuse lobe.
    pub fn leaves_diffuse(&self, cos_o: f64, cos_i: f64) -> f64 {
        (1.0 - self.reflected(cos_o)) * (1.0 - self.reflected(cos_i)) / (1.0 - self.mean)
    }

    /// What is left of a specular lobe.
    pub fn leaves_specular(&self, cos_o: f64, cos_i: f64) -> f64 {
        1.0 - self.reflected(cos_o).max(self.reflected(cos_i))
    }

    /// f cos and pdf of a rough one about the shading normal.
    pub fn lobe(&self, facing: &Facing, wi: DVec3) -> (f64, f64) {
        let Some(alpha) = self.alpha else { return (0.0, 0.0) };
        let (value, pdf) = ggx(alpha, facing, wi);
        // Half the angle between the two directions is that to the facet.
        let cos = (0.5 + 0.5 * facing.wo.dot(wi)).max(0.0).sqrt();
        (self.amount * boundary(cos) * value, pdf)
    }
}

/// The cosine at a step.
fn cosine(step: f64) -> f64 {
    (step / STEPS as f64).powi(2).max(1e-9)
}

fn boundary(cos: f64) -> f64 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt() / INDEX;
    fresnel(1.0 / INDEX, cos, (1.0 - sin * sin).sqrt())
}

/// What facets of an amount of 1 reflect in all, by draws at the middles of a grid: finer towards the tail of their slopes.
fn albedo(alpha: f64, cos: f64) -> f64 {
    let wo = DVec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let facing = Facing { wo, shading: DVec3::Z, geometric: DVec3::Z, from_behind: false };
    let mut sum = 0.0;
    for i in 0..DRAWS[0] {
        let s = (i as f64 + 0.5) / DRAWS[0] as f64;
        for j in 0..DRAWS[1] {
            // One half of the turn is the mirror image of the other.
            let turn = 0.5 * (j as f64 + 0.5) / DRAWS[1] as f64;
            let wi = draw_ggx(alpha, &facing, 1.0 - s * s, turn);
            if wi.z > 0.0 {
                let (value, pdf) = ggx(alpha, &facing, wi);
                sum += 2.0 * s * value / pdf * boundary(wo.dot((wo + wi).normalize()));
            }
        }
    }
    sum / (DRAWS[0] * DRAWS[1]) as f64
}
