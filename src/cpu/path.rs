//! The path kernel in f64, small and plain: the judge of `passes/trace/path`. The same estimator on the same random
//! numbers, so that the two can be compared path by path.

use glam::{DMat3, DVec2, DVec3, DVec4, UVec2, UVec4};

use super::bsdf::dielectric::Interface;
use super::bsdf::{Reflection, ShadingFrame};
use super::camera::camera_ray;
use super::connect::{LightSample, LightSampler, power_heuristic};
use super::normals::{bent_to_viewer, smooth_normal};
use super::pcg4d::pcg4d;
use super::reuse::{GatherPoint, Lending, LentPoint};
use super::rng::{Source, random_words, sample_key, unit};
use super::sky::sky_arriving;
use super::sun::SunDisk;
use super::texture::{TexturePoint, TextureSet};
use super::textured::Cone;
use super::triangles::{HitF64, TriangleSet};
use crate::layout::light::LightTable;
use crate::layout::sky::SkyTable;
use crate::layout::texture::{
    CUTOUT_DIMENSIONS, MaterialMaps, NO_CHANCE, TEXTURE_DIMENSIONS, TEXTURE_DIMENSIONS_PER_BOUNCE,
};
use crate::layout::trace::{
    DIMENSIONS_PER_BOUNCE, LENS_DIMENSIONS, MATERIAL_DIELECTRIC, MATERIAL_ONE_SIDED, MATERIAL_THIN, MaterialRecord,
    ROULETTE_BOUNCE, SLOT_CHOICES, SLOT_DIRECTION, SLOT_FILM, SLOT_LIGHT_POINT, SampleKey, Shading, TraceParams,
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
    /// The lights that are sampled: all with integrator `Path`, points alone with `Bsdf`.
    pub lights: Option<LightTable>,
    /// A picture of the sky, in place of the constant environment; sampled as the lights are.
    pub sky: Option<&'a SkyTable>,
    pub textures: TextureSet<'a>,
    /// Material of each triangle, in scene order: where lights have maps.
    pub materials_of: Vec<u32>,
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

/// One sample of one pixel, and what it leaves to its tile.
#[derive(Clone, Copy, Debug)]
pub struct Walked {
    /// Without what it lends.
    pub traced: Traced,
    pub gather_point: Option<GatherPoint>,
    pub lent_point: Option<LentPoint>,
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
            textures: TextureSet::default(),
            materials_of: triangles.iter().map(|triangle| triangle.material).collect(),
            sky_turn: DMat3::IDENTITY,
        }
    }

    /// A film sample of a pixel of the whole film, whose path is its own; what the kernel reads of `params` is read here.
    pub fn sample(&self, params: &TraceParams, pixel: UVec2, sample: u32) -> Traced {
        self.walk(params, pixel, sample, false).traced
    }

    /// The same of a path that lends, if `lends`: what it lends is not in its radiance.
    pub fn walk(&self, params: &TraceParams, pixel: UVec2, sample: u32, lends: bool) -> Walked {
        let key = sample_key(pixel.y * params.film_width + pixel.x, sample, params.seed);
        let at = pixel.as_dvec2() + self.sampler.sample_2d(key, SLOT_FILM);
        let (mut origin, mut direction) = camera_ray(params, at, || self.sampler.sample_2d(key, LENS_DIMENSIONS));
        let mut throughput = DVec3::ONE;
        let mut pdf = 0.0;
        // From where that was drawn, through surfaces that were passed straight on.
        let mut passed = 0.0;
        let mut eta_scale = 1.0;
        let mut cone = Cone { width: 0.0, spread: params.cone_spread.into() };
        let sampler = self.light_sampler(params);
        let sun = SunDisk::new(params);
        let mut traced = Traced::default();
        let (mut lending, mut gather_point, mut lent_point) = (Lending::default(), None, None);
        for bounce in 0..params.max_depth {
            let chance = self.chance(key, traced.rays);
            let Some(hit) = self.first_hit(origin, direction, key, &mut traced.rays) else {
                let to_picture = self.sky_turn.transpose();
                let sky =
                    self.sky.map_or(params.environment.as_dvec3(), |sky| sky_arriving(sky, to_picture * direction).0);
                let sun = sun.filter(|sun| sun.covers(direction)).map_or(DVec3::ZERO, |sun| sun.radiance);
                let other = sampler.as_ref().and_then(|sampler| sampler.sky_pdf(direction));
                let found = (sky + sun) * weight_of_finding(pdf, other);
                traced.radiance += throughput * found;
                lending.radiance += lending.throughput * found;
                break;
            };
            let material = &self.materials[hit.triangle.material as usize];
            let [a, b, c] = hit.triangle.corners;
            let area_normal = (b - a).cross(c - a);
            let texturing = self.texturing(&hit, cone, direction, (key, bounce));
            let (frame, normal) = self.frame(&hit, -direction, &texturing);
            if !(frame.back_face && material.flags & MATERIAL_ONE_SIDED != 0) {
                let pdf_of = |sampler: &LightSampler| {
                    sampler.light_pdf(hit.triangle.index, area_normal, direction, passed + hit.t)
                };
                let weight = weight_of_finding(pdf, sampler.as_ref().and_then(pdf_of));
                let point = match pdf > 0.0 {
                    true => self.textures.point(hit.triangle.index, hit.b),
                    false => texturing.point,
                };
                let part = self.emission_part(&texturing.maps, point, texturing.others.y);
                let found = material.emission.as_dvec3() * part * weight;
                traced.radiance += throughput * found;
                lending.radiance += lending.throughput * found;
            }
            if bounce + 1 == params.max_depth {
                break;
            }
            let position = origin + hit.t * direction;
            let first = bounce * DIMENSIONS_PER_BOUNCE;
            let [light, lobe, roulette, _] = self.sampler.sample_4d(key, first + SLOT_CHOICES).to_array();
            let point = self.sampler.sample_2d(key, first + SLOT_LIGHT_POINT);
            let surface =
                self.textures.textured(Reflection::from(material), &texturing.maps, texturing.point, texturing.colours);
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
                .map(|sampler| self.connect(sampler, &surface, &frame, position, (light, point, texturing.others.z)));
            if let Some(light) = connection.filter(Connection::adds) {
                let passes = params.max_depth - 2 - bounce;
                let seen = self.seen_part(position, &light.from, passes, key, &mut traced.rays);
                let seen_as = (&surface, &frame);
                let parts = lending.parts_of(throughput, seen_as, light.from.direction, light.value, 1.0);
                traced.radiance += parts[0] * light.arriving * seen;
                lending.radiance += parts[1] * light.arriving * seen;
            }
            let u = self.sampler.sample_2d(key, first + SLOT_DIRECTION);
            let drawn = surface.sample(&frame, lobe, u);
            if drawn.weight.max_element() <= 0.0 {
                break;
            }
            [throughput, lending.throughput] = lending.lend_on(throughput, (&surface, &frame), &drawn);
            lending.begins = lends && bounce == 0 && drawn.pdf > 0.0;
            eta_scale /= eta_squared(material, &frame, drawn.direction);
            if self.roulette && bounce >= ROULETTE_BOUNCE {
                let most = throughput + lending.throughput;
                let survival = (most.max_element() * eta_scale).min(1.0);
                if roulette >= survival {
                    break;
                }
                throughput /= survival;
                lending.throughput /= survival;
            }
            let curvature = self.textures.uvs.get(hit.triangle.index as usize).map_or(0.0, |uvs| uvs.curvature.into());
            cone = cone.spread_by(hit.t, curvature, &frame, &drawn, params.cone_part.into());
            origin = position;
            // What light sampling passes as well is weighted as if nothing were there.
            let straight = surface.lets_through() && drawn.pdf == 0.0 && drawn.direction == direction;
            (pdf, passed) = match straight && !is_bent(material, &texturing.maps) {
                true => (pdf, passed + hit.t),
                false => (drawn.pdf, 0.0),
            };
            direction = drawn.direction;
        }
        let lent_point = lent_point.map(|point: LentPoint| LentPoint { radiance: lending.radiance, ..point });
        Walked { traced, gather_point, lent_point: lent_point.filter(|point| point.radiance != DVec3::ZERO) }
    }

    /// What a ray hits first, of what is there for it. Hits are within 1e-15 of the scene's size, so 1e-9 leaves out the surface the ray
    /// starts on, and it alone.
    fn first_hit(&self, origin: DVec3, direction: DVec3, key: SampleKey, rays: &mut u32) -> Option<HitF64<'_>> {
        let chance = self.chance(key, *rays);
        *rays += 1;
        self.closest_there(origin, direction, chance)
    }

    /// The number by which surfaces with holes are there for a ray of a path, or not.
    fn chance(&self, key: SampleKey, ray: u32) -> u32 {
        if self.textures.maps.is_empty() { NO_CHANCE } else { random_words(key, CUTOUT_DIMENSIONS + ray).x | 1 }
    }

    /// What a ray hits first, of what is there for such a number.
    pub(super) fn closest_there(&self, origin: DVec3, direction: DVec3, chance: u32) -> Option<HitF64<'_>> {
        let is_there = |hit: &HitF64| {
            let triangle = hit.triangle.index;
            let words = pcg4d(UVec4::new(chance, triangle, CUTOUT_STREAM, 0));
            self.textures.is_there(hit.triangle.material, triangle, hit.b, [unit(words.x), unit(words.y)])
        };
        match self.textures.maps.is_empty() {
            true => self.triangles.closest(origin, direction, 1e-9),
            false => self.triangles.closest_of(origin, direction, 1e-9, is_there),
        }
    }

    /// What is known of a hit before a texel is looked up.
    fn texturing(&self, hit: &HitF64, cone: Cone, direction: DVec3, (key, bounce): (SampleKey, u32)) -> Texturing {
        let maps = self.textures.maps(hit.triangle.material);
        let ahead = cone.long_axis(hit.t, hit.triangle.corners, direction);
        let point = self.textures.point_with(hit.triangle.index, hit.b, cone.width_at(hit.t), ahead);
        let first = TEXTURE_DIMENSIONS + bounce * TEXTURE_DIMENSIONS_PER_BOUNCE;
        let [colours, others] = [first, first + 4].map(|dimension| self.sampler.sample_4d(key, dimension));
        Texturing { maps, point, colours, others }
    }

    /// What a map multiplies emission by.
    fn emission_part(&self, maps: &MaterialMaps, point: TexturePoint, u: f64) -> DVec3 {
        if maps.emission == 0 { DVec3::ONE } else { self.textures.colour(maps.emission, point, u) }
    }

    /// How a surface is seen, and the normal that it is shaded by before that is bent to its viewer.
    fn frame(&self, hit: &HitF64, wo: DVec3, texturing: &Texturing) -> (ShadingFrame, DVec3) {
        let frame = self.mesh_frame(hit, wo);
        let Texturing { maps, point, others, .. } = texturing;
        if maps.relief == 0 {
            return (frame, self.mesh_side(hit, frame.geometric));
        }
        let (n, geometric) = (self.mesh_normal(hit), frame.geometric);
        let bent = self.textures.relieved(maps, *point, hit.triangle.index, hit.b, n, others.x);
        let [seen, side] = if n.dot(geometric) < 0.0 { [-bent, -n] } else { [bent, n] };
        let unbent = bent_to_viewer(seen, side, geometric);
        (ShadingFrame { shading: bent_to_viewer(unbent, geometric, wo), ..frame }, unbent)
    }

    /// As the mesh is, without a relief.
    fn mesh_frame(&self, hit: &HitF64, wo: DVec3) -> ShadingFrame {
        let front = front_of(hit);
        let back_face = front.dot(wo) < 0.0;
        let geometric = if back_face { -front } else { front };
        let side = self.mesh_side(hit, geometric);
        ShadingFrame { wo, shading: bent_to_viewer(side, geometric, wo), geometric, back_face }
    }

    /// The mesh's normal on the side of a facet's.
    fn mesh_side(&self, hit: &HitF64, geometric: DVec3) -> DVec3 {
        let n = self.mesh_normal(hit);
        if n.dot(geometric) < 0.0 { -n } else { n }
    }

    /// That of its corners, or of the flat triangle.
    fn mesh_normal(&self, hit: &HitF64) -> DVec3 {
        let smooth = self.shading.get(hit.triangle.index as usize).and_then(|n| smooth_normal(n, hit.b));
        smooth.unwrap_or_else(|| front_of(hit))
    }

    /// What light is sampled from, if from anything.
    fn light_sampler(&self, params: &TraceParams) -> Option<LightSampler<'_>> {
        let lights = self.lights.as_ref()?;
        let sky = self.sky.filter(|sky| sky.power > 0.0 && params.sky_density > 0.0);
        let any = sky.is_some() || !lights.lights.is_empty();
        any.then(|| LightSampler {
            lights,
            sky,
            sky_turn: self.sky_turn,
            light_share: f64::from(params.light_share),
            light_density: f64::from(params.light_density),
            point_density: f64::from(params.point_density),
            sun: SunDisk::new(params),
            sun_end: f64::from(params.sun_end),
        })
    }

    /// A light that is sampled, and what of it arrives if nothing is in the way.
    fn connect(
        &self,
        sampler: &LightSampler,
        surface: &Reflection,
        frame: &ShadingFrame,
        position: DVec3,
        (pick, point, texel): (f64, DVec2, f64),
    ) -> Connection {
        let mut from = sampler.draw(position, pick, point);
        if let Some(triangle) = from.triangle {
            let material = self.materials_of[triangle as usize];
            let maps = self.textures.maps(material);
            if maps.emission != 0 {
                let point = self.textures.point(triangle, from.weights);
                let emission = self.materials[material as usize].emission.as_dvec3();
                from.radiance = emission * self.emission_part(&maps, point, texel);
            }
        }
        let above = from.direction.dot(frame.shading) > 0.0 && from.direction.dot(frame.geometric) > 0.0;
        let at = surface.evaluate(frame, from.direction);
        let counts = above && from.pdf > 0.0 && at.pdf > 0.0;
        let weight = if from.point_distance.is_some() { 1.0 } else { power_heuristic(from.pdf, at.pdf) };
        let share = if counts { weight / from.pdf } else { 0.0 };
        Connection { value: at.value, arriving: from.radiance * share, from }
    }

    /// The part of a light that arrives: what goes straight on through up to so many surfaces before it.
    fn seen_part(
        &self,
        position: DVec3,
        light: &LightSample,
        mut passes: u32,
        key: SampleKey,
        rays: &mut u32,
    ) -> DVec3 {
        let (mut origin, mut part) = (position, DVec3::ONE);
        // To a point, which no ray hits.
        let mut left = light.point_distance.map_or(f64::INFINITY, |distance| distance * (1.0 - 1e-9));
        loop {
            let hit = self.first_hit(origin, light.direction, key, rays);
            let hit = hit.filter(|hit| hit.t < left);
            if hit.as_ref().map(|hit| hit.triangle.index) == light.triangle {
                return part;
            }
            let Some(hit) = hit.filter(|_| passes > 0) else { return DVec3::ZERO };
            let (material, maps) = (hit.triangle.material, self.textures.maps(hit.triangle.material));
            let material = &self.materials[material as usize];
            if light.point_distance.is_none() && is_bent(material, &maps) {
                return DVec3::ZERO;
            }
            part *= Reflection::from(material).passed_straight(&self.mesh_frame(&hit, -light.direction));
            if part == DVec3::ZERO {
                return part;
            }
            passes -= 1;
            origin += hit.t * light.direction;
            left -= hit.t;
        }
    }
}

/// Whether a relief bends the normal by which a surface lets light pass.
fn is_bent(material: &MaterialRecord, maps: &MaterialMaps) -> bool {
    material.flags & MATERIAL_THIN != 0 && maps.relief != 0
}

/// A triangle's normal by its winding.
fn front_of(hit: &HitF64) -> DVec3 {
    let [a, b, c] = hit.triangle.corners;
    (b - a).cross(c - a).normalize()
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

/// What is known of a hit before a texel is looked up, and the numbers that draw texels.
struct Texturing {
    maps: MaterialMaps,
    point: TexturePoint,
    colours: DVec4,
    others: DVec4,
}

/// Sets the hashes that decide about holes off from those of other numbers.
const CUTOUT_STREAM: u32 = 0x6375_7400;

/// A sampled light.
struct Connection {
    from: LightSample,
    /// f * cos in its direction.
    value: DVec3,
    /// Its radiance by the density that it was drawn with, weighted against other ways to find it.
    arriving: DVec3,
}

impl Connection {
    fn adds(&self) -> bool {
        self.value * self.arriving != DVec3::ZERO
    }
}
