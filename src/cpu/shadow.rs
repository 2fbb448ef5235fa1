//! Shadow rays in f64: the twin of `passes/trace/shadow`.

use glam::{DVec2, DVec3};

use super::bsdf::{Reflection, ShadingFrame};
use super::connect::{LightSample, LightSampler, power_heuristic};
use super::observe::Observer;
use super::path::PathScene;
use super::surface::is_bent;
use super::turn::{LightDrawn, Met, RayKind, Turn};
use crate::layout::trace::SampleKey;

/// A sampled light.
pub struct Connection {
    pub from: LightSample,
    /// f * cos in its direction.
    pub value: DVec3,
    /// Its radiance by the density that it was drawn with, weighted against other ways to find it.
    pub arriving: DVec3,
}

impl Connection {
    pub fn adds(&self) -> bool {
        self.value * self.arriving != DVec3::ZERO
    }
}

/// A way to a light, from the surface that it was sampled for.
pub struct Toward<'a> {
    pub origin: DVec3,
    pub light: &'a LightSample,
    /// How many surfaces light may pass straight on.
    pub passes: u32,
    /// What the light adds to the pixel if nothing takes of it.
    pub carries: DVec3,
    /// Path segments before the one to the surface.
    pub bounce: u32,
    /// All that the pixel has before.
    pub radiance: DVec3,
}

impl PathScene<'_> {
    /// A light that is sampled, and what of it arrives if nothing is in the way.
    pub(super) fn connect(
        &self,
        sampler: &LightSampler,
        surface: &Reflection,
        frame: &ShadingFrame,
        position: DVec3,
        (point, texel): (DVec2, f64),
        watch: &mut impl Observer,
    ) -> Connection {
        let mut from = sampler.draw_bent(position, point, |direction| watch.unit(direction));
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
        watch.note(|turn| turn.draws_light(LightDrawn::of(point, &from, at, weight, above)));
        Connection { value: at.value, arriving: from.radiance * share, from }
    }

    /// The part of a light that arrives: what goes straight on through up to so many surfaces before it.
    pub(super) fn seen_part(&self, way: &Toward, key: SampleKey, rays: &mut u32, watch: &mut impl Observer) -> DVec3 {
        let Toward { mut origin, light, mut passes, carries, bounce, radiance } = *way;
        let mut part = DVec3::ONE;
        // To a point, which no ray hits.
        let mut left = light.point_distance.map_or(f64::INFINITY, |distance| distance * (1.0 - 1e-9));
        loop {
            let hit = self.first_hit(origin, light.direction, key, rays);
            let hit = hit.filter(|hit| hit.t < left);
            watch.turn(|| {
                let (kind, direction, met) = (RayKind::Shadow, light.direction, hit.as_ref().map(Met::of));
                Turn { kind, bounce, origin, direction, throughput: carries * part, met, radiance, ..Turn::default() }
            });
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
