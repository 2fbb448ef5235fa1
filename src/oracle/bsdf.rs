//! Surfaces in f64, straight from the material's numbers. All directions are unit vectors that point away from the surface.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::DVec3;

use super::coat::Coat;
pub use super::facing::{Draw, Facing};
use super::lobes::{around, draw_diffuse, draw_ggx, fresnel, ggx, phong};
use super::pane::draw_pane;
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
    /// Over both lobes.
    coat: Option<Arc<Coat>>,
    /// Index of refraction; then `tf` alone counts of what else there is.
    glass: Option<f64>,
    /// It is that of a pane as one sheet.
    thin: bool,
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

impl Bsdf {
    /// From a material and what becomes of its excess.
    pub fn new(material: &Material, energy: Energy) -> Self {
        let alpha = f64::from(material.coat_roughness).powi(2);
        let coat = Coat::new(material.coat.into(), (alpha >= LEAST_ALPHA).then_some(alpha)).map(Arc::new);
        Self { coat, ..Self::bare(material, energy) }
    }

    /// Under the coat of another.
    pub fn under(&self, material: &Material, energy: Energy) -> Self {
        Self { coat: self.coat.clone(), ..Self::bare(material, energy) }
    }

    /// Without a coat.
    fn bare(material: &Material, energy: Energy) -> Self {
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
            Passage::Glass(index) | Passage::Pane(index) => (Some(f64::from(index)), 1.0),
        };
        let (tf, thin) = (material.filter.as_dvec3(), matches!(material.passage, Passage::Pane(_)));
        Self { kd: kd / scale, ks: ks / scale, specular, coat: None, glass, thin, opacity, tf }
    }

    /// Probabilities of the lobes: diffuse, specular, straight on, and the coat. All 0 where nothing is carried.
    fn chances(&self, facing: &Facing) -> [f64; 4] {
        let coat = self.coat.as_ref().map_or(0.0, |coat| coat.reflected(facing.cos_viewer()));
        let base = self.opacity * (1.0 - coat);
        let parts = [base * self.kd, base * self.ks, (1.0 - self.opacity) * self.tf, DVec3::splat(self.opacity * coat)];
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
        let [diffuse, specular, _, coated] = self.chances(facing);
        let cosine_lobe = FRAC_1_PI * cos / facing.visible_part();
        let left = |of: fn(&Coat, f64, f64) -> f64, cos_i: f64| {
            self.coat.as_ref().map_or(1.0, |coat| of(coat, facing.cos_viewer(), cos_i))
        };
        let (mut lobe, mut lobe_pdf, mut coat, mut coat_pdf) = (0.0, 0.0, 0.0, 0.0);
        for from in [wi, facing.off_surface(wi)] {
            if from.dot(facing.shading) > 0.0 {
                let (more, more_pdf) = match self.specular {
                    Specular::Phong(n) => phong(n, facing, from),
                    Specular::Ggx(alpha) => ggx(alpha, facing, from),
                    Specular::Mirror => (0.0, 0.0),
                };
                let under = left(Coat::leaves_specular, from.dot(facing.shading));
                (lobe, lobe_pdf) = (lobe + under * more, lobe_pdf + more_pdf);
                let (more, more_pdf) = self.coat.as_ref().map_or((0.0, 0.0), |coat| coat.lobe(facing, from));
                (coat, coat_pdf) = (coat + more, coat_pdf + more_pdf);
            }
        }
        let under = left(Coat::leaves_diffuse, facing.cos_unhidden(wi));
        let value = self.opacity * (self.kd * under * cosine_lobe + self.ks * lobe + coat);
        (value, diffuse * cosine_lobe + specular * lobe_pdf + coated * coat_pdf)
    }

    /// A direction to go on in; none where the light is lost.
    pub fn draw(&self, facing: &Facing, random: &mut Random) -> Option<Draw> {
        if let (Some(index), true) = (self.glass, self.thin) {
            return draw_pane(index, self.tf, facing, random);
        }
        if let Some(index) = self.glass {
            return Some(draw_glass(index, self.tf, facing, random));
        }
        let [diffuse, specular, straight, coated] = self.chances(facing);
        let mirrored = |weight: DVec3| Some(Draw { wi: facing.leaving(facing.mirror()), weight, pdf: 0.0 });
        let pick = random.unit();
        let wi = if pick < straight {
            let weight = self.tf * ((1.0 - self.opacity) / straight);
            return Some(Draw { wi: -facing.wo, weight, pdf: 0.0 });
        } else if let (true, Some(coat)) = (pick > 1.0 - coated, &self.coat) {
            let Some(alpha) = coat.alpha() else {
                return mirrored(DVec3::splat(self.opacity * coat.reflected(facing.cos_viewer()) / coated));
            };
            facing.drawn(draw_ggx(alpha, facing, random.unit(), random.unit()))?
        } else if pick < straight + diffuse {
            draw_diffuse(facing, random)?
        } else if specular <= 0.0 {
            return None;
        } else {
            let (u, v) = (random.unit(), random.unit());
            facing.drawn(match self.specular {
                Specular::Phong(n) => around(facing.mirror(), (1.0 - u).powf(1.0 / (n + 1.0)), v),
                Specular::Ggx(alpha) => draw_ggx(alpha, facing, u, v),
                Specular::Mirror => {
                    let cos = facing.cos_viewer();
                    let under = self.coat.as_ref().map_or(1.0, |coat| coat.leaves_specular(cos, cos));
                    return mirrored(self.ks * (self.opacity * under / specular));
                }
            })?
        };
        let (value, pdf) = self.evaluate(facing, wi);
        (pdf > 0.0).then(|| Draw { wi, weight: value / pdf, pdf })
    }
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
