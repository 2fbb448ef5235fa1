//! The path kernel in f64, small and plain: the judge of `passes/trace/path`. The same estimator on the same random
//! numbers, so that the two can be compared path by path.

use glam::{DVec2, DVec3, UVec2};

use super::bsdf::dielectric::Interface;
use super::bsdf::{BsdfSample, Reflection, ShadingFrame};
use super::camera::camera_ray;
use super::connect::{LightSampler, power_heuristic};
use super::observe::{Observer, Unwatched};
use super::reuse::{GatherPoint, Lending, LentPoint};
use super::rng::sample_key;
pub use super::scene::PathScene;
use super::shadow::{Connection, Toward};
use super::sky::sky_arriving;
use super::sun::SunDisk;
use super::surface::is_bent;
use super::textured::Cone;
use super::turn::{DirectionDrawn, Met, SurfaceSeen, Turn};
use crate::layout::trace::{
    DIMENSIONS_PER_BOUNCE, LENS_DIMENSIONS, MATERIAL_DIELECTRIC, MATERIAL_ONE_SIDED, MaterialRecord, ROULETTE_BOUNCE,
    SLOT_CHOICES, SLOT_DIRECTION, SLOT_FILM, SLOT_LIGHT_POINT, TraceParams,
};

/// One sample of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    pub radiance: DVec3,
    /// Rays that were traced for it.
    pub rays: u32,
}

/// One sample of one pixel, and what it leaves to its tile.
#[derive(Clone, Copy, Debug)]
pub struct Walked {
    /// Without what it lends.
    pub traced: Traced,
    pub gather_point: Option<GatherPoint>,
    pub lent_point: Option<LentPoint>,
}

impl PathScene<'_> {
    /// A film sample of a pixel of the whole film, whose path is its own; what the kernel reads of `params` is read here.
    pub fn sample(&self, params: &TraceParams, pixel: UVec2, sample: u32) -> Traced {
        self.walk(params, pixel, sample, false).traced
    }

    /// The same of a path that lends, if `lends`: what it lends is not in its radiance.
    pub fn walk(&self, params: &TraceParams, pixel: UVec2, sample: u32, lends: bool) -> Walked {
        self.walk_watched(params, pixel, sample, lends, &mut Unwatched)
    }

    /// The same, while somebody watches. As long as a bounce has steps: what each of them makes, the next reads.
    pub fn walk_watched(
        &self,
        params: &TraceParams,
        pixel: UVec2,
        sample: u32,
        lends: bool,
        watch: &mut impl Observer,
    ) -> Walked {
        let key = sample_key(pixel.y * params.film_width + pixel.x, sample, params.seed);
        let at = pixel.as_dvec2() + self.sampler.sample_2d(key, SLOT_FILM);
        let (mut origin, direction) = camera_ray(params, at, || self.sampler.sample_2d(key, LENS_DIMENSIONS));
        let mut direction = watch.unit(direction);
        let mut throughput = DVec3::ONE;
        let mut pdf = 0.0;
        // From where that was drawn, through surfaces that were passed straight on.
        let mut passed = 0.0;
        let mut eta_scale = 1.0;
        let mut cone = Cone { width: 0.0, spread: params.cone_spread.into() };
        let sampler = self.light_sampler(params);
        let mut traced = Traced::default();
        let (mut lending, mut gather_point, mut lent_point) = (Lending::default(), None, None);
        for bounce in 0..params.max_depth {
            let chance = self.chance(key, traced.rays);
            let hit = self.first_hit(origin, direction, key, &mut traced.rays);
            watch.turn(|| {
                let (lent, met, radiance) = (lending.throughput, hit.as_ref().map(Met::of), traced.radiance);
                Turn { bounce, origin, direction, throughput, lent, pdf, met, radiance, ..Turn::default() }
            });
            let Some(mut hit) = hit else {
                let (arriving, other) = self.beyond(params, sampler.as_ref(), direction);
                let found = arriving * weight_of_finding(pdf, other);
                traced.radiance += throughput * found;
                lending.radiance += lending.throughput * found;
                watch.note(|turn| turn.found(arriving, other, throughput * found, traced.radiance));
                break;
            };
            let position = origin + hit.t * direction;
            let position = watch.place(&mut hit, position);
            let material = &self.materials[hit.triangle.material as usize];
            let [a, b, c] = hit.triangle.corners;
            let area_normal = (b - a).cross(c - a);
            let texturing = self.texturing(&hit, cone, direction, (key, bounce));
            let (frame, normal) = self.frame(&hit, -direction, &texturing);
            let frame = shaken(frame, watch);
            if !(frame.back_face && material.flags & MATERIAL_ONE_SIDED != 0) {
                let pdf_of = |sampler: &LightSampler| {
                    sampler.light_pdf(hit.triangle.index, area_normal, direction, passed + hit.t)
                };
                let other = sampler.as_ref().and_then(pdf_of);
                let weight = weight_of_finding(pdf, other);
                let point = match pdf > 0.0 {
                    true => self.textures.point(hit.triangle.index, hit.b),
                    false => texturing.point,
                };
                let part = self.emission_part(&texturing.maps, point, texturing.others.y);
                let emitted = material.emission.as_dvec3() * part;
                let found = emitted * weight;
                traced.radiance += throughput * found;
                lending.radiance += lending.throughput * found;
                watch.note(|turn| turn.found(emitted, other, throughput * found, traced.radiance));
            }
            if bounce + 1 == params.max_depth {
                break;
            }
            let first = bounce * DIMENSIONS_PER_BOUNCE;
            let choices = self.sampler.sample_2d(key, first + SLOT_CHOICES);
            let [lobe, roulette] = choices.to_array().map(|u| watch.number(u));
            let point = self.sampler.sample_2d(key, first + SLOT_LIGHT_POINT);
            let point = DVec2::from(point.to_array().map(|u| watch.number(u)));
            let surface =
                self.textures.textured(Reflection::from(material), &texturing.maps, texturing.point, texturing.colours);
            watch.note(|turn| turn.surface = Some(SurfaceSeen::of(position, &frame, choices)));
            if lends && bounce == 0 {
                gather_point = Some(GatherPoint { position, frame, surface });
            }
            if lending.begins {
                let (triangle, geometric, weight) = (hit.triangle.index, frame.geometric, throughput);
                let radiance = DVec3::ZERO;
                lent_point = Some(LentPoint { position, triangle, geometric, normal, radiance, chance, weight });
            }
            let connection = sampler
                .as_ref()
                .map(|sampler| self.connect(sampler, &surface, &frame, position, (point, texturing.others.z), watch));
            if let Some(light) = connection.filter(Connection::adds) {
                let seen_as = (&surface, &frame);
                let parts = lending.parts_of(throughput, seen_as, light.from.direction, light.value, 1.0);
                let origin = watch.leave(&hit, position, &frame, light.from.direction);
                let carries = parts[0] * light.arriving;
                let (passes, radiance) = (params.max_depth - 2 - bounce, traced.radiance);
                let way = Toward { origin, light: &light.from, passes, carries, bounce, radiance };
                let seen = self.seen_part(&way, key, &mut traced.rays, watch);
                traced.radiance += carries * seen;
                lending.radiance += parts[1] * light.arriving * seen;
                watch.note_last(|turn| (turn.added, turn.radiance) = (carries * seen, traced.radiance));
            }
            let u = self.sampler.sample_2d(key, first + SLOT_DIRECTION);
            let drawn = surface.sample(&frame, lobe, u);
            // What light sampling passes as well is weighted as if nothing were there.
            let straight = surface.lets_through() && drawn.pdf == 0.0 && drawn.direction == direction;
            let drawn = if straight { drawn } else { redrawn(drawn, &surface, &frame, watch) };
            watch.note(|turn| turn.drawn = Some(DirectionDrawn::of(u, &drawn)));
            if drawn.weight.max_element() <= 0.0 {
                break;
            }
            [throughput, lending.throughput] = lending.lend_on(throughput, (&surface, &frame), &drawn);
            lending.begins = lends && bounce == 0 && drawn.pdf > 0.0;
            eta_scale /= eta_squared(material, &frame, drawn.direction);
            if self.roulette && bounce >= ROULETTE_BOUNCE {
                let most = throughput + lending.throughput;
                let survival = (most.max_element() * eta_scale).min(1.0);
                watch.note(|turn| turn.plays(survival));
                if roulette >= survival {
                    break;
                }
                throughput /= survival;
                lending.throughput /= survival;
            }
            watch.note(Turn::goes_on);
            let curvature = self.textures.uvs.get(hit.triangle.index as usize).map_or(0.0, |uvs| uvs.curvature.into());
            cone = cone.spread_by(hit.t, curvature, &frame, &drawn, params.cone_part.into());
            origin = watch.leave(&hit, position, &frame, drawn.direction);
            (pdf, passed) = match straight && !is_bent(material, &texturing.maps) {
                true => (pdf, passed + hit.t),
                false => (drawn.pdf, 0.0),
            };
            direction = drawn.direction;
        }
        let lent_point = lent_point.map(|point: LentPoint| LentPoint { radiance: lending.radiance, ..point });
        Walked { traced, gather_point, lent_point: lent_point.filter(|point| point.radiance != DVec3::ZERO) }
    }

    /// What arrives from sky and sun along a direction, and the density with which that is sampled, if it is.
    fn beyond(&self, params: &TraceParams, sampler: Option<&LightSampler>, direction: DVec3) -> (DVec3, Option<f64>) {
        let to_picture = self.sky_turn.transpose();
        let sky = self.sky.map_or(params.environment.as_dvec3(), |sky| sky_arriving(sky, to_picture * direction).0);
        let sun = SunDisk::new(params).filter(|sun| sun.covers(direction)).map_or(DVec3::ZERO, |sun| sun.radiance);
        (sky + sun, sampler.and_then(|sampler| sampler.sky_pdf(direction)))
    }
}

/// How a surface is seen, by normals that whoever watches may have shaken; those of a flat triangle stay one.
fn shaken(frame: ShadingFrame, watch: &mut impl Observer) -> ShadingFrame {
    let shading = watch.normal(frame.shading);
    match frame.shading == frame.geometric {
        true => ShadingFrame { shading, geometric: shading, ..frame },
        false => ShadingFrame { shading, ..frame },
    }
}

/// A direction that was drawn, as whoever watches may have shaken it, with what the surface says of that one.
fn redrawn(drawn: BsdfSample, surface: &Reflection, frame: &ShadingFrame, watch: &mut impl Observer) -> BsdfSample {
    let direction = watch.unit(drawn.direction);
    if direction == drawn.direction || drawn.pdf == 0.0 || drawn.weight == DVec3::ZERO {
        return BsdfSample { direction, ..drawn };
    }
    let at = surface.evaluate(frame, direction);
    let weight = if at.pdf > 0.0 { at.value / at.pdf } else { DVec3::ZERO };
    BsdfSample { direction, pdf: at.pdf, weight }
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
