//! Directions towards lights: emitting triangles by their power, and the environment.

use std::f64::consts::PI;

use glam::DVec3;

use super::choice::{Distribution, luminance};
use super::random::Random;
use super::scene::Scene;
use super::sky::Sky;
use super::tree::Hit;

/// All light sources of a scene.
pub struct Lights {
    /// Triangles by their power, as if their brightest texel were everywhere.
    choice: Distribution,
    areas: Vec<f64>,
    sky: Option<Sky>,
    /// Probability of asking the environment.
    sky_chance: f64,
}

/// A direction in which there may be a light.
pub struct Ask {
    pub wi: DVec3,
    /// By solid angle, of this light.
    pub pdf: f64,
    /// The triangle that must be met; none is the environment.
    pub triangle: Option<u32>,
}

impl Lights {
    pub fn new(scene: &Scene) -> Self {
        let areas: Vec<f64> = scene.triangles.iter().map(|t| 0.5 * t.winding().length()).collect();
        let power = |(triangle, area): (&super::scene::Triangle, &f64)| {
            let substance = &scene.substances[triangle.substance];
            let sides = if substance.one_sided() { 1.0 } else { 2.0 };
            sides * PI * area * luminance(substance.brightest())
        };
        let choice = Distribution::new(scene.triangles.iter().zip(&areas).map(power));
        let sky = scene.environment.as_ref().map(Sky::new).filter(|sky| !sky.is_black());
        let sky_chance = match (&sky, choice.is_empty()) {
            (None, _) => 0.0,
            (Some(_), true) => 1.0,
            (Some(_), false) => 0.5,
        };
        Self { choice, areas, sky, sky_chance }
    }

    /// A direction from a point; none where there are no lights.
    pub fn draw(&self, scene: &Scene, from: DVec3, random: &mut Random) -> Option<Ask> {
        if let Some(sky) = &self.sky
            && random.unit() < self.sky_chance
        {
            let wi = sky.draw(random);
            return Some(Ask { wi, pdf: self.pdf_of_sky(wi), triangle: None });
        }
        if self.choice.is_empty() {
            return None;
        }
        let index = self.choice.draw(random.unit());
        let [a, b, c] = scene.triangles[index].corners;
        let (root, v) = (random.unit().sqrt(), random.unit());
        let to = (1.0 - root) * a + root * (1.0 - v) * b + root * v * c - from;
        let hit = Hit { t: to.length(), b: [0.0; 2], triangle: index as u32 };
        let wi = to / hit.t;
        Some(Ask { wi, pdf: self.pdf_of_hit(scene, &hit, wi), triangle: Some(hit.triangle) })
    }

    /// Density by which a surface asks for the point that a ray of this direction hits.
    pub fn pdf_of_hit(&self, scene: &Scene, hit: &Hit, direction: DVec3) -> f64 {
        let index = hit.triangle as usize;
        let chance = (1.0 - self.sky_chance) * self.choice.chance(index);
        if chance == 0.0 {
            return 0.0;
        }
        let cos = scene.triangles[index].winding().normalize().dot(direction).abs();
        chance / self.areas[index] * hit.t * hit.t / cos
    }

    /// Density by which a surface asks for the environment in a direction.
    pub fn pdf_of_sky(&self, direction: DVec3) -> f64 {
        self.sky.as_ref().map_or(0.0, |sky| self.sky_chance * sky.pdf(direction))
    }

    /// Radiance that comes from beyond the scene along a ray.
    pub fn sky_radiance(&self, direction: DVec3) -> DVec3 {
        self.sky.as_ref().map_or(DVec3::ZERO, |sky| sky.radiance(direction))
    }
}
