//! Light sampling in f64: the twin of `passes/trace/connect`, of `lib/light`, and so of the part of integrator `Path` that `Bsdf` lacks.

use glam::{DVec2, DVec3};

use crate::layout::light::{LightRecord, LightTable};
use crate::layout::trace::luminance;

/// Light that arrives at a point from one drawn direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit length.
    pub direction: DVec3,
    /// To the point of the light, scene units.
    pub distance: f64,
    /// By solid angle; 0 where nothing arrives.
    pub pdf: f64,
    pub radiance: DVec3,
    /// Index of the light's triangle in scene order.
    pub triangle: u32,
}

/// A light by its power, by one number, and a point of it, by two. There is at least one light.
pub fn draw_light(table: &LightTable, position: DVec3, pick: f64, u: DVec2) -> LightSample {
    let lights = &table.lights;
    let scaled = pick * lights.len() as f64;
    let column = (scaled as usize).min(lights.len() - 1);
    let own = scaled - (column as f64) < f64::from(lights[column].threshold);
    let light = &lights[if own { column } else { lights[column].other as usize }];
    let [a, b, c] = [light.a, light.b, light.c].map(|corner| corner.as_dvec3());
    let half = 0.5 * u.min_element();
    let weights = u - half;
    let offset = a + weights.x * (b - a) + weights.y * (c - a) - position;
    let distance = offset.length();
    let direction = offset / distance;
    let raw = (b - a).cross(c - a);
    let lit = light.sides == 2 || raw.dot(direction) < 0.0;
    let pdf = solid_angle_pdf(area_pdf(table, light), raw, direction, distance);
    LightSample {
        direction,
        distance,
        pdf: if lit { pdf } else { 0.0 },
        radiance: light.emission.as_dvec3(),
        triangle: light.triangle,
    }
}

fn area_pdf(table: &LightTable, light: &LightRecord) -> f64 {
    f64::from(luminance(light.emission)) * f64::from(light.sides) * f64::from(table.density)
}

/// The density by solid angle of a direction of unit length that meets a light of normal `raw`, of any length, at a distance.
pub fn solid_angle_pdf(area_pdf: f64, raw: DVec3, direction: DVec3, distance: f64) -> f64 {
    area_pdf * distance * distance / raw.normalize().dot(direction).abs().max(1e-12)
}

/// The density with which a light is drawn in a direction that was found to meet it; none if the triangle is no light.
pub fn light_pdf(table: &LightTable, triangle: u32, raw: DVec3, direction: DVec3, distance: f64) -> Option<f64> {
    let at = table.lights.binary_search_by_key(&triangle, |light| light.triangle).ok()?;
    Some(solid_angle_pdf(area_pdf(table, &table.lights[at]), raw, direction, distance))
}

/// Weight of a direction drawn with density `own`, where another way draws it with density `other` (power heuristic of exponent
/// 2; Veach 1997, section 9.2.4). `own` is above 0.
pub fn power_heuristic(own: f64, other: f64) -> f64 {
    1.0 / (1.0 + (other / own).powi(2))
}
