//! Light sampling in f64: the twin of `passes/trace/connect`, of `lib/light`, and so of the part of integrator `Path` that `Bsdf` lacks.

use glam::{DMat3, DVec2, DVec3};

use super::cdf::{draw_index, stretched};
use super::point::point_intensity;
use super::sky::{draw_sky, sky_arriving};
use super::sun::SunDisk;
use crate::layout::light::{LightRecord, LightTable, PointLightRecord};
use crate::layout::sky::SkyTable;
use crate::layout::trace::luminance;

/// Light that arrives at a point from one drawn direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit length.
    pub direction: DVec3,
    /// By solid angle, of lights, sky and sun together; 0 where nothing arrives. Of a point light the probability with which it is drawn,
    /// times the square of the distance.
    pub pdf: f64,
    /// Of a point light, its intensity.
    pub radiance: DVec3,
    /// How far away a point light is; none of all that a ray could have found.
    pub point_distance: Option<f64>,
    /// Index of the light's triangle in scene order; none for the sky and for points.
    pub triangle: Option<u32>,
    /// Row of a point light in the table of lights; none of all others.
    pub point: Option<u32>,
    /// Weights of its second and third corner.
    pub weights: [f64; 2],
}

/// What light is sampled from: there are lights, or the sky has power.
pub struct LightSampler<'a> {
    pub lights: &'a LightTable,
    /// None where it is not sampled.
    pub sky: Option<&'a SkyTable>,
    /// From directions of its picture to those of the scene: a rotation.
    pub sky_turn: DMat3,
    /// Probability of sampling one of the lights, and not the sky.
    pub light_share: f64,
    /// Density by area with which a point of a triangle of unit luminance and one side is drawn.
    pub light_density: f64,
    /// Probability with which a point light of unit power is drawn.
    pub point_density: f64,
    /// None without one; sampled if the sky is.
    pub sun: Option<SunDisk>,
    /// Numbers from `light_share` to this are of the sun.
    pub sun_end: f64,
}

impl LightSampler<'_> {
    /// Light at a position: `u` chooses the light, and what is left of it the point there.
    pub fn draw(&self, position: DVec3, u: DVec2) -> LightSample {
        self.draw_bent(position, u, |direction| direction)
    }

    /// The same in a direction that `bend` makes of the one that was drawn.
    pub fn draw_bent(&self, position: DVec3, u: DVec2, bend: impl FnOnce(DVec3) -> DVec3) -> LightSample {
        match self.sky {
            Some(sky) if self.lights.lights.is_empty() || u.x >= self.light_share => {
                let direction = match &self.sun {
                    Some(sun) if u.x < self.sun_end => sun.draw(within(u, self.light_share, self.sun_end)),
                    _ => self.sky_turn * draw_sky(sky, within(u, self.sun_end, 1.0)).direction,
                };
                let direction = bend(direction);
                let (radiance, pdf) = self.beyond(sky, direction);
                LightSample {
                    direction,
                    pdf,
                    radiance,
                    point_distance: None,
                    triangle: None,
                    point: None,
                    weights: [0.0; 2],
                }
            }
            Some(_) => self.draw_light(position, within(u, 0.0, self.light_share), bend),
            None => self.draw_light(position, u, bend),
        }
    }

    /// The density with which a light is drawn in a direction that was found to meet it; none if the triangle is no light.
    pub fn light_pdf(&self, triangle: u32, area_normal: DVec3, direction: DVec3, distance: f64) -> Option<f64> {
        let lights = &self.lights.lights;
        let at = lights.binary_search_by_key(&triangle, |light| light.triangle).ok()?;
        Some(solid_angle_pdf(self.area_pdf(&lights[at]), area_normal, direction, distance))
    }

    /// The density with which a direction that was found to meet the sky is drawn; none if that is not sampled.
    pub fn sky_pdf(&self, direction: DVec3) -> Option<f64> {
        self.sky.map(|sky| self.beyond(sky, direction).1)
    }

    /// Radiance of sky and sun from a direction, and the density with which it is drawn.
    fn beyond(&self, sky: &SkyTable, direction: DVec3) -> (DVec3, f64) {
        let (radiance, pdf) = sky_arriving(sky, self.sky_turn.transpose() * direction);
        let pdf = (1.0 - self.sun_end) * pdf;
        match self.sun.filter(|sun| sun.covers(direction)) {
            Some(sun) => (radiance + sun.radiance, pdf + sun.density),
            None => (radiance, pdf),
        }
    }

    /// A light by its power, and a point of it. There is at least one light.
    fn draw_light(&self, position: DVec3, u: DVec2, bend: impl FnOnce(DVec3) -> DVec3) -> LightSample {
        let lights = &self.lights.lights;
        let (row, rest) = draw_index(lights.len(), u.x, |index| (lights[index].end, lights[index].first));
        let u = DVec2::new(rest, u.y);
        let light = &lights[row];
        if let Some(point) = light.point() {
            return LightSample { point: Some(row as u32), ..self.draw_point(&point, position, bend) };
        }
        let [a, b, c] = [light.a, light.b, light.c].map(|corner| corner.as_dvec3());
        let half = 0.5 * u.min_element();
        let weights = u - half;
        let offset = a + weights.x * (b - a) + weights.y * (c - a) - position;
        let distance = offset.length();
        let direction = bend(offset / distance);
        let area_normal = (b - a).cross(c - a);
        let lit = light.sides() == 2 || area_normal.dot(direction) < 0.0;
        let pdf = solid_angle_pdf(self.area_pdf(light), area_normal, direction, distance);
        LightSample {
            direction,
            pdf: if lit { pdf } else { 0.0 },
            radiance: light.emission.as_dvec3(),
            point_distance: None,
            triangle: Some(light.triangle),
            point: None,
            weights: weights.to_array(),
        }
    }

    fn draw_point(&self, light: &PointLightRecord, position: DVec3, bend: impl FnOnce(DVec3) -> DVec3) -> LightSample {
        let offset = light.position.as_dvec3() - position;
        let distance = offset.length();
        let direction = bend(offset.normalize_or_zero());
        LightSample {
            direction,
            pdf: f64::from(light.power) * self.point_density * distance * distance,
            radiance: point_intensity(light, -direction),
            point_distance: Some(distance),
            triangle: None,
            point: None,
            weights: [0.0; 2],
        }
    }

    fn area_pdf(&self, light: &LightRecord) -> f64 {
        f64::from(luminance(light.emission)) * f64::from(light.sides()) * self.light_density
    }
}

/// Two numbers of which the first is from `start` to `end`, which is stretched.
fn within(u: DVec2, start: f64, end: f64) -> DVec2 {
    DVec2::new(stretched(u.x, start, end), u.y)
}

/// The density by solid angle of a direction of unit length that meets a light of normal `area_normal`, of any length, at a distance.
fn solid_angle_pdf(area_pdf: f64, area_normal: DVec3, direction: DVec3, distance: f64) -> f64 {
    area_pdf * distance * distance / area_normal.normalize().dot(direction).abs().max(1e-12)
}

/// Weight of a direction drawn with density `own`, where another way draws it with density `other` (power heuristic of exponent
/// 2; Veach 1997, section 9.2.4). `own` is above 0.
pub fn power_heuristic(own: f64, other: f64) -> f64 {
    1.0 / (1.0 + (other / own).powi(2))
}
