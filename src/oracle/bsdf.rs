//! Surfaces in f64, straight from the material's numbers. All directions are unit vectors that point away from the surface.

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use glam::{DMat3, DVec3};

use super::random::Random;
use crate::components::{Energy, Lobe, Material, Passage};

/// Least alpha of a rough conductor, as the definition of `roughness` has it.
const LEAST_ALPHA: f64 = 1e-4;

/// What a surface does with light.
#[derive(Clone, Debug)]
pub struct Bsdf {
    kd: DVec3,
    ks: DVec3,
    specular: Specular,
    /// Index of refraction; then `tf` alone counts of what else there is.
    glass: Option<f64>,
    /// Part of the light that meets the surface at all.
    opacity: f64,
    tf: DVec3,
}

#[derive(Clone, Copy, Debug)]
enum Specular {
    /// f = ks (n + 2) / (2 pi) cos^n(alpha), alpha from the mirror direction (Lafortune and Willems 1994).
    Phong(f64),
    /// f = ks D G2 / (4 cos cos), the microfacets of Walter et al. 2007 by their alpha, Smith's G2 height-correlated
    /// (Heitz 2014).
    Ggx(f64),
    Mirror,
}

/// How a surface is seen. Both normals are on the side of `wo`.
///
/// Where they differ, what a specular lobe sends into the true surface is mirrored by it, and a diffuse one is made stronger by as much as
/// the true surface hides of it.
#[derive(Clone, Copy, Debug)]
pub struct Facing {
    pub wo: DVec3,
    pub shading: DVec3,
    pub geometric: DVec3,
    /// Seen from the side where the winding is clockwise.
    pub from_behind: bool,
}

/// A way on.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    pub wi: DVec3,
    /// f cos / pdf.
    pub weight: DVec3,
    /// By solid angle; 0 where the direction is the only one that its lobe has.
    pub pdf: f64,
}

impl Bsdf {
    /// From a material and what becomes of its excess.
    pub fn new(material: &Material, energy: Energy) -> Self {
        let (kd, ks) = (material.diffuse.as_dvec3(), material.specular.as_dvec3());
        let metallic = f64::from(material.metallic);
        let (kd, ks) = (kd * (1.0 - metallic), ks + kd * metallic);
        let scale = match energy {
            Energy::Preserve => (kd + ks).max_element().max(1.0),
            Energy::AsWritten => 1.0,
        };
        let specular = match material.lobe {
            Lobe::Ggx(roughness) => Specular::Ggx(f64::from(roughness).powi(2).max(LEAST_ALPHA)),
            Lobe::Mirror => Specular::Mirror,
            Lobe::Phong(exponent) => Specular::Phong(f64::from(exponent).clamp(0.0, 1e5)),
        };
        let (glass, opacity) = match material.passage {
            Passage::Opaque => (None, 1.0),
            Passage::SeeThrough(opacity) => (None, f64::from(opacity)),
            Passage::Glass(index) => (Some(f64::from(index)), 1.0),
        };
        Self { kd: kd / scale, ks: ks / scale, specular, glass, opacity, tf: material.filter.as_dvec3() }
    }

    /// Probabilities of the lobes: diffuse, specular, straight on. All 0 where nothing is carried.
    fn chances(&self) -> [f64; 3] {
        let parts = [self.opacity * self.kd, self.opacity * self.ks, (1.0 - self.opacity) * self.tf];
        let parts = parts.map(|part| part.element_sum());
        let sum: f64 = parts.iter().sum();
        parts.map(|part| if sum > 0.0 { part / sum } else { 0.0 })
    }

    /// f cos, and the density by which [`Bsdf::draw`] finds `wi`, by solid angle; lobes of a single direction left out.
    pub fn evaluate(&self, facing: &Facing, wi: DVec3) -> (DVec3, f64) {
        let cos = wi.dot(facing.shading);
        if self.glass.is_some() || cos <= 0.0 || wi.dot(facing.geometric) <= 0.0 {
            return (DVec3::ZERO, 0.0);
        }
        let [diffuse, specular, _] = self.chances();
        let cosine_lobe = FRAC_1_PI * cos / facing.visible_part();
        let (mut lobe, mut lobe_pdf) = (0.0, 0.0);
        for from in [wi, facing.off_surface(wi)] {
            if from.dot(facing.shading) > 0.0 {
                let (more, more_pdf) = match self.specular {
                    Specular::Phong(n) => phong(n, facing, from),
                    Specular::Ggx(alpha) => ggx(alpha, facing, from),
                    Specular::Mirror => (0.0, 0.0),
                };
                (lobe, lobe_pdf) = (lobe + more, lobe_pdf + more_pdf);
            }
        }
        let value = self.opacity * (self.kd * cosine_lobe + self.ks * lobe);
        (value, diffuse * cosine_lobe + specular * lobe_pdf)
    }

    /// A direction to go on in; none where the light is lost.
    pub fn draw(&self, facing: &Facing, random: &mut Random) -> Option<Draw> {
        if let Some(index) = self.glass {
            return Some(draw_glass(index, self.tf, facing, random));
        }
        let [diffuse, specular, straight] = self.chances();
        let pick = random.unit();
        let wi = if pick < straight {
            let weight = self.tf * ((1.0 - self.opacity) / straight);
            return Some(Draw { wi: -facing.wo, weight, pdf: 0.0 });
        } else if pick < straight + diffuse {
            draw_diffuse(facing, random)?
        } else if specular <= 0.0 {
            return None;
        } else {
            let (u, v) = (random.unit(), random.unit());
            let wi = match self.specular {
                Specular::Phong(n) => around(facing.mirror(), (1.0 - u).powf(1.0 / (n + 1.0)), v),
                Specular::Ggx(alpha) => draw_ggx(alpha, facing, u, v),
                Specular::Mirror => {
                    let (wi, weight) = (facing.leaving(facing.mirror()), self.ks * (self.opacity / specular));
                    return Some(Draw { wi, weight, pdf: 0.0 });
                }
            };
            if wi.dot(facing.shading) <= 0.0 {
                return None;
            }
            facing.leaving(wi)
        };
        let (value, pdf) = self.evaluate(facing, wi);
        (pdf > 0.0).then(|| Draw { wi, weight: value / pdf, pdf })
    }
}

impl Facing {
    /// `wo` reflected about the shading normal.
    fn mirror(&self) -> DVec3 {
        2.0 * self.wo.dot(self.shading) * self.shading - self.wo
    }

    /// A direction reflected by the true surface, from above or from below.
    fn off_surface(&self, wi: DVec3) -> DVec3 {
        wi.reflect(self.geometric)
    }

    /// A direction of the viewer's side, once the true surface has reflected it if it must.
    fn leaving(&self, wi: DVec3) -> DVec3 {
        if wi.dot(self.geometric) < 0.0 { self.off_surface(wi) } else { wi }
    }

    /// Part of a cosine lobe about the shading normal that is above the true surface.
    fn visible_part(&self) -> f64 {
        0.5 + 0.5 * self.shading.dot(self.geometric)
    }

    /// Columns: two tangents and the shading normal.
    fn frame(&self) -> DMat3 {
        let (s, t) = self.shading.any_orthonormal_pair();
        DMat3::from_cols(s, t, self.shading)
    }
}

/// The direction at an angle of this cosine from unit `axis`, `turn` turns about it.
fn around(axis: DVec3, cos: f64, turn: f64) -> DVec3 {
    let (s, t) = axis.any_orthonormal_pair();
    let (sin_turn, cos_turn) = (TAU * turn).sin_cos();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    (sin * (cos_turn * s + sin_turn * t) + cos * axis).normalize()
}

/// By the cosine about the shading normal, of the directions above the true surface; at least every second one is.
fn draw_diffuse(facing: &Facing, random: &mut Random) -> Option<DVec3> {
    const TRIES: usize = 64;
    (0..TRIES)
        .map(|_| around(facing.shading, (1.0 - random.unit()).sqrt(), random.unit()))
        .find(|wi| wi.dot(facing.geometric) > 0.0)
}

/// f cos and pdf of the Phong lobe of reflectance 1.
fn phong(n: f64, facing: &Facing, wi: DVec3) -> (f64, f64) {
    let cos_alpha = facing.mirror().dot(wi);
    let lobe = if cos_alpha > 0.0 { cos_alpha.powf(n) / TAU } else { 0.0 };
    ((n + 2.0) * lobe * wi.dot(facing.shading), (n + 1.0) * lobe)
}

/// f cos and pdf of the GGX lobe of reflectance 1, drawn by the normals that `wo` sees.
fn ggx(alpha: f64, facing: &Facing, wi: DVec3) -> (f64, f64) {
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
fn draw_ggx(alpha: f64, facing: &Facing, u: f64, v: f64) -> DVec3 {
    let frame = facing.frame();
    let o = frame.transpose() * facing.wo;
    let stretch = DVec3::new(alpha, alpha, 1.0);
    let seen = (o * stretch).normalize();
    let z = (1.0 - u) * (1.0 + seen.z) - seen.z;
    let cap = around(DVec3::Z, z.clamp(-1.0, 1.0), v);
    let h = ((cap + seen) * stretch).normalize();
    frame * (2.0 * o.dot(h) * h - o)
}

/// Reflected by Fresnel's part, else refracted. Radiance over the square of the index is what a boundary keeps, so what
/// comes from the denser side is weaker on the other.
fn draw_glass(index: f64, tf: DVec3, facing: &Facing, random: &mut Random) -> Draw {
    let ratio = if facing.from_behind { index } else { 1.0 / index };
    let passes = |normal: DVec3| 1.0 - ratio * ratio * (1.0 - facing.wo.dot(normal).powi(2));
    // Where a shading normal would keep in what the true surface lets out, the true surface decides: or light could be caught for ever.
    let caught = passes(facing.shading) <= 0.0 && passes(facing.geometric) > 0.0;
    let facing = &Facing { shading: if caught { facing.geometric } else { facing.shading }, ..*facing };
    let (cos, cos2_beyond) = (facing.wo.dot(facing.shading), passes(facing.shading));
    let reflected = if cos2_beyond > 0.0 { fresnel(ratio, cos, cos2_beyond.sqrt()) } else { 1.0 };
    if random.unit() < reflected {
        return Draw { wi: facing.leaving(facing.mirror()), weight: DVec3::ONE, pdf: 0.0 };
    }
    let wi = (facing.shading * (ratio * cos - cos2_beyond.sqrt()) - ratio * facing.wo).normalize();
    Draw { wi: -facing.leaving(-wi), weight: tf * (ratio * ratio), pdf: 0.0 }
}

/// Unpolarised reflectance of a boundary, `ratio` being the index here by that beyond.
fn fresnel(ratio: f64, cos: f64, cos_beyond: f64) -> f64 {
    let parallel = (cos - ratio * cos_beyond) / (cos + ratio * cos_beyond);
    let perpendicular = (ratio * cos - cos_beyond) / (ratio * cos + cos_beyond);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
