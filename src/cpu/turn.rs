//! What is known of a ray of a path, in f64: noted by the twin, or read from what the kernel kept.

use glam::{DVec2, DVec3};

use super::bsdf::{BsdfSample, BsdfValue, ShadingFrame};
use super::connect::LightSample;
use super::triangles::HitF64;
use crate::layout::ray::NO_HIT;
use crate::layout::replay::{PathTurn, RAY_SHADOW, TURN_DRAWN, TURN_GOES_ON, TURN_LIGHT, TURN_SURFACE};

/// A ray of a path, and what came of it: [`PathTurn`]'s words, and what is not there is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Turn {
    pub kind: RayKind,
    /// Path segments before it; of a shadow ray, before the one to its surface.
    pub bounce: u32,
    pub origin: DVec3,
    pub direction: DVec3,
    /// What a unit of radiance along the ray adds to the pixel; of a shadow ray, what its light adds if it is seen.
    pub throughput: DVec3,
    /// What it adds to what the path lends.
    pub lent: DVec3,
    /// Density of the direction; 0 where it could have been no other.
    pub pdf: f64,
    pub met: Option<Met>,
    /// What arrives from the ray's end, and what light sampling finds it with; 0 where it can't.
    pub emitted: DVec3,
    pub found_pdf: f64,
    /// What the pixel got of the ray.
    pub added: DVec3,
    pub surface: Option<SurfaceSeen>,
    pub light: Option<LightDrawn>,
    pub drawn: Option<DirectionDrawn>,
    /// All that the pixel has so far.
    pub radiance: DVec3,
    /// A number of it was no radiance: `radiance` is that.
    pub is_bad: bool,
    /// Known to the twin alone.
    pub slack: Slack,
}

/// By how much f32 moves a point of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slack {
    /// Along the triangle, scene units.
    pub position: f64,
    /// Off it, along its normal, where a ray leaves.
    pub offset: f64,
    /// The weights of its corners.
    pub weights: f64,
    /// Cosine between the ray and the triangle's normal, at least 0.
    pub cos: f64,
}

/// Whose ray it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RayKind {
    #[default]
    Segment,
    /// To a light that was sampled.
    Shadow,
}

/// Where a ray met a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    pub t: f64,
    /// In scene order.
    pub triangle: u32,
    pub material: u32,
    /// Weights of the second and third corner.
    pub b: DVec2,
}

/// A surface that a path goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSeen {
    pub position: DVec3,
    pub geometric: DVec3,
    pub shading: DVec3,
    pub back_face: bool,
    /// Random numbers: which lobe, and whether the path survives.
    pub choices: DVec2,
}

/// A light that was sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightDrawn {
    /// The random number that its point comes from.
    pub u: DVec2,
    /// None for sky, sun and points.
    pub triangle: Option<u32>,
    /// Row of a point light in the table of lights: known to the twin alone.
    pub point: Option<u32>,
    pub direction: DVec3,
    pub pdf: f64,
    pub radiance: DVec3,
    /// f * cos of its direction, and the density with which the surface would draw it.
    pub value: DVec3,
    pub bsdf_pdf: f64,
    /// Beside finding it by chance; 0 where nothing of it is sent on.
    pub weight: f64,
}

/// A direction that a surface drew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionDrawn {
    pub u: DVec2,
    pub direction: DVec3,
    /// 0 where its lobe has no other, or where nothing is carried.
    pub pdf: f64,
    pub weight: DVec3,
    /// Of roulette.
    pub survival: f64,
    pub goes_on: bool,
}

impl Turn {
    /// Whether a shadow ray's light was seen.
    pub fn is_seen(&self) -> bool {
        self.added != DVec3::ZERO
    }
}

/// What the twin notes.
impl Turn {
    /// What arrived from the ray's end, what light sampling finds it with, and what came of it.
    pub fn found(&mut self, emitted: DVec3, pdf: Option<f64>, added: DVec3, radiance: DVec3) {
        (self.emitted, self.found_pdf, self.added, self.radiance) = (emitted, pdf.unwrap_or(0.0), added, radiance);
        self.forget_unused();
    }

    /// A density that nothing was weighted by is none.
    fn forget_unused(&mut self) {
        if self.pdf == 0.0 || self.emitted == DVec3::ZERO {
            self.found_pdf = 0.0;
        }
    }

    /// A light of which nothing is sent on is as none: how likely it was is no matter, and edge-on to it is rounding's alone.
    fn forget_dark(&mut self) {
        if let Some(light) = self.light.as_mut().filter(|light| light.value == DVec3::ZERO) {
            *light = LightDrawn { pdf: 0.0, radiance: DVec3::ZERO, bsdf_pdf: 0.0, weight: 0.0, ..*light };
        }
    }

    /// A light was sampled.
    pub fn draws_light(&mut self, light: LightDrawn) {
        self.light = Some(light);
        self.forget_dark();
    }

    /// Roulette was played.
    pub fn plays(&mut self, survival: f64) {
        self.drawn.iter_mut().for_each(|drawn| drawn.survival = survival);
    }

    /// The path goes on.
    pub fn goes_on(&mut self) {
        self.drawn.iter_mut().for_each(|drawn| drawn.goes_on = true);
    }
}

impl Met {
    pub fn of(hit: &HitF64) -> Self {
        Self { t: hit.t, triangle: hit.triangle.index, material: hit.triangle.material, b: hit.b.into() }
    }
}

impl SurfaceSeen {
    pub fn of(position: DVec3, frame: &ShadingFrame, choices: DVec2) -> Self {
        let ShadingFrame { shading, geometric, back_face, .. } = *frame;
        Self { position, geometric, shading, back_face, choices }
    }
}

impl LightDrawn {
    /// `at`: what the surface does with the light's direction, where that is above it.
    pub fn of(u: DVec2, from: &LightSample, at: BsdfValue, weight: f64, above: bool) -> Self {
        let LightSample { direction, pdf, radiance, triangle, point, .. } = *from;
        let (value, bsdf_pdf) = if above { (at.value, at.pdf) } else { (DVec3::ZERO, 0.0) };
        let weight = if pdf > 0.0 && bsdf_pdf > 0.0 { weight } else { 0.0 };
        Self { u, triangle, point, direction, pdf, radiance, value, bsdf_pdf, weight }
    }
}

impl DirectionDrawn {
    pub fn of(u: DVec2, drawn: &BsdfSample) -> Self {
        let BsdfSample { direction, pdf, weight } = *drawn;
        let pdf = if weight == DVec3::ZERO { 0.0 } else { pdf };
        Self { u, direction, pdf, weight, survival: 1.0, goes_on: false }
    }
}

/// What the kernel kept, as it was traced.
pub fn turns_of(kept: &[PathTurn]) -> Vec<Turn> {
    let mut bounce = 0;
    let read = |kept: &PathTurn| {
        let mut turn = Turn::from(kept);
        turn.forget_unused();
        turn.forget_dark();
        match turn.kind {
            RayKind::Segment => bounce = turn.bounce,
            RayKind::Shadow => turn.bounce = bounce,
        }
        turn
    };
    kept.iter().map(read).collect()
}

impl From<&PathTurn> for Turn {
    fn from(kept: &PathTurn) -> Self {
        let has = |flag: u32| kept.done & flag != 0;
        let index = |triangle: u32| (triangle != NO_HIT).then_some(triangle);
        let weight = kept.drawn_weight.as_dvec3();
        Self {
            kind: if kept.kind == RAY_SHADOW { RayKind::Shadow } else { RayKind::Segment },
            bounce: kept.bounce,
            origin: kept.origin.as_dvec3(),
            direction: kept.direction.as_dvec3(),
            throughput: kept.throughput.as_dvec3(),
            lent: kept.lent.as_dvec3(),
            pdf: kept.pdf.into(),
            met: index(kept.triangle).map(|triangle| Met {
                t: kept.t.into(),
                triangle,
                material: kept.material,
                b: DVec2::new(kept.b1.into(), kept.b2.into()),
            }),
            emitted: kept.emitted.as_dvec3(),
            found_pdf: kept.found_pdf.into(),
            added: kept.added.as_dvec3(),
            surface: has(TURN_SURFACE).then(|| SurfaceSeen {
                position: kept.position.as_dvec3(),
                geometric: kept.geometric.as_dvec3(),
                shading: kept.shading.as_dvec3(),
                back_face: kept.back_face != 0,
                choices: kept.choices.as_dvec2(),
            }),
            light: has(TURN_LIGHT).then(|| LightDrawn {
                u: kept.light_u.as_dvec2(),
                triangle: index(kept.light_triangle),
                point: None,
                direction: kept.light_direction.as_dvec3(),
                pdf: kept.light_pdf.into(),
                radiance: kept.light_radiance.as_dvec3(),
                value: kept.light_value.as_dvec3(),
                bsdf_pdf: kept.light_bsdf_pdf.into(),
                weight: kept.light_weight.into(),
            }),
            drawn: has(TURN_DRAWN).then(|| DirectionDrawn {
                u: kept.drawn_u.as_dvec2(),
                direction: kept.drawn_direction.as_dvec3(),
                pdf: if weight == DVec3::ZERO { 0.0 } else { kept.drawn_pdf.into() },
                weight,
                survival: kept.survival.into(),
                goes_on: has(TURN_GOES_ON),
            }),
            radiance: kept.radiance.as_dvec3(),
            is_bad: kept.fault != 0,
            slack: Slack::default(),
        }
    }
}
