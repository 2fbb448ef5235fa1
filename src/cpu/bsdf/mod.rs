//! BSDFs in f64: the oracle of `lib/bsdf` and `lib/sampling`. Directions are unit vectors that point away from the surface.

pub mod coat;
pub mod dielectric;
mod directions;
pub mod ggx;
pub mod pane;

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use self::coat::Coat;
use self::dielectric::Interface;
pub use self::directions::{cos_power, mirror, sample_cosine, sample_phong};
use crate::layout::trace::{
    MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MATERIAL_THIN, MaterialRecord, luminance,
};

/// A material's numbers in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    pub kd: DVec3,
    pub ks: DVec3,
    /// What `ks` is the reflectance of.
    pub specular: Specular,
    /// Probability of sampling the specular lobe instead of the diffuse one.
    pub specular_probability: f64,
    /// Over both.
    pub coat: Coat,
    /// Part of the light that passes straight through, and the probability of following it.
    pub transparency: f64,
    /// What light that passes is multiplied by.
    pub tf: DVec3,
    /// Index of a smooth dielectric, which is nothing else.
    pub dielectric: Option<f64>,
    /// Index of a pane as one sheet, which is nothing else.
    pub pane: Option<f64>,
}

/// A specular lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Specular {
    /// Of this exponent.
    Phong(f64),
    /// Of this alpha.
    Ggx(f64),
    Mirror,
}

/// How a surface is seen: unit vectors, both normals on the side of `wo`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingFrame {
    pub wo: DVec3,
    pub shading: DVec3,
    pub geometric: DVec3,
    /// The viewer is behind the surface, by its winding.
    pub back_face: bool,
}

/// A BSDF in one pair of directions, but for lobes of a single direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfValue {
    /// f times the cosine of the incident direction.
    pub value: DVec3,
    /// Of the whole mixture, by solid angle. Below the shading normal there is density, and nothing is carried.
    pub pdf: f64,
}

/// A direction drawn from a BSDF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    pub direction: DVec3,
    /// Of the whole mixture, by solid angle; 0 where the direction is the only one that its lobe has.
    pub pdf: f64,
    /// f cos / pdf, or such a lobe's value by its probability; 0 where nothing is carried.
    pub weight: DVec3,
}

impl From<&MaterialRecord> for Reflection {
    fn from(record: &MaterialRecord) -> Self {
        let MaterialRecord { kd, ks, ns, specular_probability, flags, tf, ni, alpha, transparency, .. } = *record;
        let MaterialRecord { coat, coat_alpha, .. } = *record;
        let specular = match () {
            () if flags & MATERIAL_GGX != 0 => Specular::Ggx(f64::from(alpha)),
            () if flags & MATERIAL_MIRROR != 0 => Specular::Mirror,
            () => Specular::Phong(f64::from(ns)),
        };
        Self {
            kd: kd.as_dvec3(),
            ks: ks.as_dvec3(),
            specular,
            specular_probability: f64::from(specular_probability),
            coat: Coat { amount: coat.into(), alpha: (coat_alpha > 0.0).then(|| coat_alpha.into()) },
            transparency: f64::from(transparency),
            tf: tf.as_dvec3(),
            dielectric: (flags & MATERIAL_DIELECTRIC != 0).then_some(f64::from(ni)),
            pane: (flags & MATERIAL_THIN != 0).then_some(f64::from(ni)),
        }
    }
}

impl ShadingFrame {
    /// Of a flat surface, from its front.
    pub fn flat(n: DVec3, wo: DVec3) -> Self {
        Self { wo, shading: n, geometric: n, back_face: false }
    }

    fn is_above(&self, wi: DVec3) -> bool {
        wi.dot(self.shading) > 0.0 && wi.dot(self.geometric) > 0.0
    }

    /// What the true surface makes of a direction: its mirror image.
    fn mirrored(&self, wi: DVec3) -> DVec3 {
        wi - 2.0 * wi.dot(self.geometric) * self.geometric
    }

    /// A direction that does not run into the true surface from the viewer's side.
    fn kept_above(&self, wi: DVec3) -> DVec3 {
        if wi.dot(self.geometric) < 0.0 { self.mirrored(wi) } else { wi }
    }

    /// What is left of the cosine lobe about the shading normal above the true surface, as a part of the whole.
    fn visible_part(&self) -> f64 {
        0.5 * (1.0 + self.shading.dot(self.geometric))
    }

    /// A direction of that lobe, moved above the true surface with its density: chords of the lobe's disc are shortened.
    fn crowded(&self, wi: DVec3) -> DVec3 {
        let lean = self.geometric.reject_from_normalized(self.shading);
        if lean.length() < 1e-6 {
            return wi;
        }
        let e = lean.normalize();
        let (x, y) = (wi.dot(e.cross(self.shading)), wi.dot(e));
        let end = (1.0 - x * x).max(0.0).sqrt();
        let y = end + self.visible_part() * (y - end);
        x * e.cross(self.shading) + y * e + (1.0 - x * x - y * y).max(0.0).sqrt() * self.shading
    }

    /// The cosine to the shading normal of the direction that is moved to this one.
    fn cos_before_crowding(&self, wi: DVec3) -> f64 {
        let lean = self.geometric.reject_from_normalized(self.shading);
        if lean.length() < 1e-6 {
            return wi.dot(self.shading);
        }
        let e = lean.normalize();
        let (x, y) = (wi.dot(e.cross(self.shading)), wi.dot(e));
        let end = (1.0 - x * x).max(0.0).sqrt();
        let y = end - (end - y) / self.visible_part();
        (1.0 - x * x - y * y).max(0.0).sqrt()
    }
}

impl Reflection {
    /// f times the cosine of `wi` about the shading normal.
    pub fn evaluate(&self, frame: &ShadingFrame, wi: DVec3) -> BsdfValue {
        let (mut value, mut pdf) = (DVec3::ZERO, 0.0);
        if self.dielectric.or(self.pane).is_some() {
            return BsdfValue { value, pdf };
        }
        let (cos_o, cos_theta) = (frame.wo.dot(frame.shading), wi.dot(frame.shading));
        let coated = self.coated(frame);
        let specular_probability = (1.0 - coated) * self.specular_probability;
        if frame.is_above(wi) {
            let diffuse = cos_theta / PI / frame.visible_part();
            let left = self.coat.over_diffuse(cos_o, frame.cos_before_crowding(wi));
            (value, pdf) = (self.kd * diffuse * left, (1.0 - coated - specular_probability) * diffuse);
            for from in [wi, frame.mirrored(wi)].into_iter().filter(|from| from.dot(frame.shading) > 0.0) {
                let (specular, specular_pdf) = self.specular(frame, from);
                let (coat, coat_pdf) = self.coat.lobe(frame.shading, frame.wo, from);
                value += self.ks * specular * self.coat.over_specular(cos_o, from.dot(frame.shading)) + coat;
                pdf += specular_probability * specular_pdf + coated * coat_pdf;
            }
        } else if cos_theta <= 0.0 {
            pdf = specular_probability * self.specular(frame, wi).1
                + coated * self.coat.lobe(frame.shading, frame.wo, wi).1;
        }
        let opacity = 1.0 - self.transparency;
        BsdfValue { value: opacity * value, pdf: opacity * pdf }
    }

    /// The part of the value that is the same seen from anywhere: the diffuse lobe, where no coat is over it.
    pub fn seen_from_anywhere(&self, frame: &ShadingFrame, wi: DVec3) -> DVec3 {
        if self.dielectric.or(self.pane).is_some() || self.coat.amount > 0.0 || !frame.is_above(wi) {
            return DVec3::ZERO;
        }
        (1.0 - self.transparency) * self.kd * wi.dot(frame.shading) / PI / frame.visible_part()
    }

    /// Probability of sampling the coat instead of what is below it.
    fn coated(&self, frame: &ShadingFrame) -> f64 {
        self.coat.share(frame.wo.dot(frame.shading), f64::from(luminance((self.kd + self.ks).as_vec3())))
    }

    /// f cos and pdf of the specular lobe of reflectance 1 about the shading normal, before the true surface mirrors what is below it.
    fn specular(&self, frame: &ShadingFrame, wi: DVec3) -> (f64, f64) {
        let ShadingFrame { wo, shading: n, .. } = *frame;
        match self.specular {
            Specular::Phong(ns) => {
                let lobe = cos_power(mirror(n, wo), wi, ns) / TAU;
                ((ns + 2.0) * lobe * n.dot(wi), (ns + 1.0) * lobe)
            }
            Specular::Ggx(alpha) => (ggx::value(alpha, n, wo, wi), ggx::pdf(alpha, n, wo, wi)),
            Specular::Mirror => (0.0, 0.0),
        }
    }

    /// Whether any light passes without a turn.
    pub fn lets_through(&self) -> bool {
        self.transparency > 0.0 || self.pane.is_some()
    }

    /// The part of the light that passes without a turn.
    pub fn passed_straight(&self, frame: &ShadingFrame) -> DVec3 {
        let pane = self.pane.map_or(DVec3::ZERO, |ni| pane::split(ni, self.tf, frame.wo.dot(frame.shading))[1]);
        self.transparency * self.tf + (1.0 - self.transparency) * pane
    }

    /// A direction: `pick` chooses the lobe, `u` the direction in it, all in [0, 1).
    pub fn sample(&self, frame: &ShadingFrame, pick: f64, u: DVec2) -> BsdfSample {
        let ShadingFrame { wo, shading: n, .. } = *frame;
        if pick < self.transparency {
            return BsdfSample { direction: -wo, pdf: 0.0, weight: self.tf };
        }
        let pick = (pick - self.transparency) / (1.0 - self.transparency);
        if let Some(ni) = self.dielectric {
            return self.sample_dielectric(&Interface::new(ni, frame.back_face), frame, pick);
        }
        if let Some(ni) = self.pane {
            let [reflected, passed] = pane::split(ni, self.tf, wo.dot(n));
            let weights = [reflected, passed].map(|part| f64::from(luminance(part.as_vec3())));
            let share = weights[0] / weights.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            return match pick < share {
                true => BsdfSample { direction: frame.kept_above(mirror(n, wo)), pdf: 0.0, weight: reflected / share },
                false => BsdfSample { direction: -wo, pdf: 0.0, weight: passed / (1.0 - share) },
            };
        }
        let (coated, cos_o) = (self.coated(frame), wo.dot(n));
        if pick < coated {
            let Some(alpha) = self.coat.alpha else {
                let weight = DVec3::splat(self.coat.reflectance(cos_o) / coated);
                return BsdfSample { direction: frame.kept_above(mirror(n, wo)), pdf: 0.0, weight };
            };
            return self.sampled(frame, ggx::sample(alpha, n, wo, u));
        }
        let pick = (pick - coated) / (1.0 - coated);
        let specular = pick < self.specular_probability;
        let lobe = match self.specular {
            Specular::Phong(ns) if specular => sample_phong(mirror(n, wo), ns, u),
            Specular::Ggx(alpha) if specular => ggx::sample(alpha, n, wo, u),
            Specular::Mirror if specular => mirror(n, wo),
            _ => frame.crowded(sample_cosine(n, u)),
        };
        if specular && self.specular == Specular::Mirror {
            let left = self.coat.over_specular(cos_o, cos_o) / (1.0 - coated);
            let weight = self.ks * left / self.specular_probability;
            return BsdfSample { direction: frame.kept_above(lobe), pdf: 0.0, weight };
        }
        self.sampled(frame, lobe)
    }

    /// A direction that a lobe with density has drawn.
    fn sampled(&self, frame: &ShadingFrame, lobe: DVec3) -> BsdfSample {
        // Below the shading normal a lobe carries nothing, wherever the surface is.
        let direction = if lobe.dot(frame.shading) > 0.0 { frame.kept_above(lobe) } else { lobe };
        let BsdfValue { value, pdf } = self.evaluate(frame, direction);
        BsdfSample { direction, pdf, weight: if pdf > 0.0 { value / pdf } else { DVec3::ZERO } }
    }

    fn sample_dielectric(&self, at: &Interface, frame: &ShadingFrame, pick: f64) -> BsdfSample {
        let ShadingFrame { wo, shading, geometric, .. } = *frame;
        // Total reflection about a smooth normal can catch light for ever: where it is not total by the true one, that one counts.
        let n = if at.refracted(shading, wo).is_none() && at.refracted(geometric, wo).is_some() {
            geometric
        } else {
            shading
        };
        let passed = at.refracted(n, wo).filter(|_| pick >= at.reflectance(n.dot(wo)));
        let (direction, weight) = match passed {
            Some(wi) => (-frame.kept_above(-wi), self.tf * at.eta_squared()),
            None => (frame.kept_above(mirror(n, wo)), DVec3::ONE),
        };
        BsdfSample { direction, pdf: 0.0, weight }
    }
}
