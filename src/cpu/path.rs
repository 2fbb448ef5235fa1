//! The path kernel in f64, small and plain: the judge of `passes/trace/path`. The same estimator on the same random
//! numbers, so that the two can be compared path by path.

use glam::{DMat3, DVec2, DVec3, UVec2};

use super::bsdf::dielectric::Interface;
use super::bsdf::{Reflection, ShadingFrame};
use super::connect::{LightSample, LightSampler, power_heuristic};
use super::rng::{Source, sample_key};
use super::sky::sky_arriving;
use super::sun::SunDisk;
use super::triangles::{HitF64, TriangleSet};
use crate::layout::light::LightTable;
use crate::layout::sky::SkyTable;
use crate::layout::trace::{
    DIMENSIONS_PER_BOUNCE, LEAST_FACING, MATERIAL_DIELECTRIC, MATERIAL_ONE_SIDED, MaterialRecord, ROULETTE_BOUNCE,
    SLOT_CHOICES, SLOT_DIRECTION, SLOT_FILM, SLOT_LIGHT_POINT, Shading, TraceParams,
};
use crate::layout::tree::Triangle;

/// A scene as the trace kernel gets it.
pub struct PathScene<'a> {
    pub triangles: TriangleSet,
    pub materials: &'a [MaterialRecord],
    /// In scene order; empty: geometric normals everywhere.
    pub shading: &'a [Shading],
    /// Russian roulette.
    pub roulette: bool,
    /// Of random numbers.
    pub sampler: Source,
    /// The lights that are sampled: integrator `Path`.
    pub lights: Option<LightTable>,
    /// A picture of the sky, in place of the constant environment; sampled as the lights are.
    pub sky: Option<&'a SkyTable>,
    /// From directions of that picture to those of the scene: a rotation.
    pub sky_turn: DMat3,
}

/// One sample of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    pub radiance: DVec3,
    /// Rays that were traced for it.
    pub rays: u32,
}

impl<'a> PathScene<'a> {
    /// Without shading normals and without roulette.
    pub fn new(triangles: &[Triangle], materials: &'a [MaterialRecord]) -> Self {
        Self {
            triangles: TriangleSet::new(triangles),
            materials,
            shading: &[],
            roulette: false,
            sampler: Source::Pcg,
            lights: None,
            sky: None,
            sky_turn: DMat3::IDENTITY,
        }
    }

    /// A film sample of a pixel of the whole film; what the kernel reads of `params` is read here.
    pub fn sample(&self, params: &TraceParams, pixel: UVec2, sample: u32) -> Traced {
        let key = sample_key(pixel.y * params.film_width + pixel.x, sample, params.seed);
        let mut origin = params.position.as_dvec3();
        let mut direction = camera_direction(params, pixel.as_dvec2() + self.sampler.sample_2d(key, SLOT_FILM));
        let mut throughput = DVec3::ONE;
        let mut pdf = 0.0;
        let mut eta_scale = 1.0;
        let sampler = self.light_sampler(params);
        let sun = SunDisk::new(params);
        let mut traced = Traced::default();
        for bounce in 0..params.max_depth {
            traced.rays += 1;
            // Hits are within 1e-15 of the scene's size, so this leaves out the surface the ray starts on, and it alone.
            let Some(hit) = self.triangles.closest(origin, direction, 1e-9) else {
                let to_picture = self.sky_turn.transpose();
                let sky =
                    self.sky.map_or(params.environment.as_dvec3(), |sky| sky_arriving(sky, to_picture * direction).0);
                let sun = sun.filter(|sun| sun.covers(direction)).map_or(DVec3::ZERO, |sun| sun.radiance);
                let other = sampler.as_ref().and_then(|sampler| sampler.sky_pdf(direction));
                traced.radiance += throughput * (sky + sun) * weight_of_finding(pdf, other);
                break;
            };
            let material = &self.materials[hit.triangle.material as usize];
            let frame = self.frame(&hit, -direction);
            if !(frame.back_face && material.flags & MATERIAL_ONE_SIDED != 0) {
                let [a, b, c] = hit.triangle.corners;
                let area_normal = (b - a).cross(c - a);
                let pdf_of =
                    |sampler: &LightSampler| sampler.light_pdf(hit.triangle.index, area_normal, direction, hit.t);
                let weight = weight_of_finding(pdf, sampler.as_ref().and_then(pdf_of));
                traced.radiance += throughput * material.emission.as_dvec3() * weight;
            }
            if bounce + 1 == params.max_depth {
                break;
            }
            let position = origin + hit.t * direction;
            let first = bounce * DIMENSIONS_PER_BOUNCE;
            let [light, lobe, roulette, _] = self.sampler.sample_4d(key, first + SLOT_CHOICES).to_array();
            let point = self.sampler.sample_2d(key, first + SLOT_LIGHT_POINT);
            let connection =
                sampler.as_ref().map(|sampler| self.connect(sampler, material, &frame, position, (light, point)));
            if let Some(light) = connection.filter(|connection| connection.light != DVec3::ZERO) {
                traced.rays += 1;
                if self.sees(position, &light.from) {
                    traced.radiance += throughput * light.light;
                }
            }
            let u = self.sampler.sample_2d(key, first + SLOT_DIRECTION);
            let drawn = Reflection::from(material).sample(&frame, lobe, u);
            if drawn.weight.max_element() <= 0.0 {
                break;
            }
            throughput *= drawn.weight;
            eta_scale /= eta_squared(material, &frame, drawn.direction);
            if self.roulette && bounce >= ROULETTE_BOUNCE {
                let survival = (throughput.max_element() * eta_scale).min(1.0);
                if roulette >= survival {
                    break;
                }
                throughput /= survival;
            }
            origin = position;
            (direction, pdf) = (drawn.direction, drawn.pdf);
        }
        traced
    }

    fn frame(&self, hit: &HitF64, wo: DVec3) -> ShadingFrame {
        let [a, b, c] = hit.triangle.corners;
        let area_normal = (b - a).cross(c - a).normalize();
        let back_face = area_normal.dot(wo) < 0.0;
        let geometric = if back_face { -area_normal } else { area_normal };
        let smooth = self.shading.get(hit.triangle.index as usize).and_then(|n| smooth_normal(n, hit.b));
        let shading =
            smooth.map_or(geometric, |n| bent_to_viewer(if n.dot(geometric) < 0.0 { -n } else { n }, geometric, wo));
        ShadingFrame { wo, shading, geometric, back_face }
    }

    /// What light is sampled from, if from anything.
    fn light_sampler(&self, params: &TraceParams) -> Option<LightSampler<'_>> {
        let lights = self.lights.as_ref()?;
        let sky = self.sky.filter(|sky| sky.power > 0.0);
        let any = sky.is_some() || !lights.lights.is_empty();
        any.then(|| LightSampler {
            lights,
            sky,
            sky_turn: self.sky_turn,
            light_share: f64::from(params.light_share),
            sun: SunDisk::new(params),
            sun_end: f64::from(params.sun_end),
        })
    }

    /// A light that is sampled, and what it adds for a throughput of 1 if nothing is in the way.
    fn connect(
        &self,
        sampler: &LightSampler,
        material: &MaterialRecord,
        frame: &ShadingFrame,
        position: DVec3,
        (pick, point): (f64, DVec2),
    ) -> Connection {
        let from = sampler.draw(position, pick, point);
        let above = from.direction.dot(frame.shading) > 0.0 && from.direction.dot(frame.geometric) > 0.0;
        let at = Reflection::from(material).evaluate(frame, from.direction);
        let counts = above && from.pdf > 0.0 && at.pdf > 0.0;
        let share = if counts { power_heuristic(from.pdf, at.pdf) / from.pdf } else { 0.0 };
        Connection { from, light: at.value * from.radiance * share }
    }

    /// Whether the first thing in the direction of a light is that light.
    fn sees(&self, position: DVec3, light: &LightSample) -> bool {
        let hit = self.triangles.closest(position, light.direction, 1e-9);
        hit.map(|hit| hit.triangle.index) == light.triangle
    }
}

/// What light counts for that was hit along a direction of such a pdf, where light sampling has another, if any: that
/// counts for the rest.
fn weight_of_finding(pdf: f64, sampling: Option<f64>) -> f64 {
    sampling.filter(|_| pdf > 0.0).map_or(1.0, |sampling| power_heuristic(pdf, sampling))
}

/// What refraction multiplies radiance by in a direction, 1 where there is none.
fn eta_squared(material: &MaterialRecord, frame: &ShadingFrame, direction: DVec3) -> f64 {
    let crosses = material.flags & MATERIAL_DIELECTRIC != 0 && direction.dot(frame.geometric) < 0.0;
    if crosses { Interface::new(f64::from(material.ni), frame.back_face).eta_squared() } else { 1.0 }
}

/// A sampled light.
struct Connection {
    from: LightSample,
    light: DVec3,
}

/// Unit direction through a point of the whole film, in pixels from its top left corner.
pub fn camera_direction(params: &TraceParams, at: DVec2) -> DVec3 {
    let size = DVec2::new(f64::from(params.film_width), f64::from(params.film_height));
    let s = (2.0 * at / size - 1.0) * DVec2::new(1.0, -1.0);
    (params.forward.as_dvec3() + s.x * params.right.as_dvec3() + s.y * params.up.as_dvec3()).normalize()
}

/// The interpolated normal at weights of the second and third corner, unit length; none where a corner has none or they cancel.
pub fn smooth_normal(corners: &Shading, b: [f64; 2]) -> Option<DVec3> {
    let words = [corners.n0, corners.n1, corners.n2];
    if words.contains(&0) {
        return None;
    }
    let [n0, n1, n2] = words.map(octahedral_decode);
    let n = (1.0 - b[0] - b[1]) * n0 + b[0] * n1 + b[1] * n2;
    (n.length_squared() >= 1e-6).then(|| n.normalize())
}

/// A shading normal turned towards its viewer, as little as makes it seen at all, where its facet is.
fn bent_to_viewer(n: DVec3, facet: DVec3, wo: DVec3) -> DVec3 {
    let least = f64::from(LEAST_FACING).min(wo.dot(facet));
    if n.dot(wo) < least { (n.reject_from_normalized(wo) + least * wo).normalize() } else { n }
}

/// A unit vector from its octahedral snorm16 pair (Cigolle et al., JCGT 3(2), 2014).
pub fn octahedral_decode(word: u32) -> DVec3 {
    let snorm = |half: u32| (f64::from(half as u16 as i16) / 32767.0).max(-1.0);
    let (x, y) = (snorm(word), snorm(word >> 16));
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let shrink = |v: f64| if v >= 0.0 { v - fold } else { v + fold };
    DVec3::new(shrink(x), shrink(y), z).normalize()
}
