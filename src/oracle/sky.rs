//! The environment: radiance by direction, and directions by radiance.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::choice::{Distribution, luminance};
use super::random::Random;
use crate::components::Environment;

/// A picture of the sphere of directions by longitude and latitude, constant over each pixel. A constant environment is
/// a picture of one pixel.
pub struct Sky {
    width: usize,
    height: usize,
    pixels: Vec<DVec3>,
    /// From directions of the picture to those of the scene.
    turn: DMat3,
    /// Pixels by luminance times solid angle.
    choice: Distribution,
}

impl Sky {
    pub fn new(environment: &Environment) -> Self {
        let (width, height, pixels, turn) = match environment {
            Environment::Constant(radiance) => (1, 1, vec![radiance.as_dvec3()], DMat3::IDENTITY),
            Environment::Map { image, strength, tint, turn } => {
                let factor = f64::from(*strength) * tint.as_dvec3();
                let pixels = image.pixels.iter().map(|p| p.as_dvec3() * factor).collect();
                (image.size.x as usize, image.size.y as usize, pixels, *turn)
            }
        };
        let mut sky = Self { width, height, pixels, turn, choice: Distribution::default() };
        let power = |i: usize| luminance(sky.pixels[i]) * sky.solid_angle(i);
        sky.choice = Distribution::new((0..sky.pixels.len()).map(power));
        sky
    }

    pub fn is_black(&self) -> bool {
        self.choice.is_empty()
    }

    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        self.pixels[self.pixel_at(direction)]
    }

    /// Density of [`Sky::draw`], by solid angle.
    pub fn pdf(&self, direction: DVec3) -> f64 {
        let pixel = self.pixel_at(direction);
        self.choice.chance(pixel) / self.solid_angle(pixel)
    }

    /// A pixel by its power, and a direction evenly in its solid angle.
    pub fn draw(&self, random: &mut Random) -> DVec3 {
        let pixel = self.choice.draw(random.unit());
        let (row, column) = (pixel / self.width, pixel % self.width);
        let (low, high) = (self.cos_above(row + 1), self.cos_above(row));
        let cos = low + (high - low) * random.unit();
        let turn = (column as f64 + random.unit()) / self.width as f64 - 0.5;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.turn * DVec3::new(sin * (TAU * turn).sin(), cos, -sin * (TAU * turn).cos())
    }

    fn pixel_at(&self, direction: DVec3) -> usize {
        let direction = self.turn.inverse() * direction;
        let column = self.width as f64 * (0.5 + direction.x.atan2(-direction.z) / TAU);
        let row = self.height as f64 * direction.y.clamp(-1.0, 1.0).acos() / PI;
        (row as usize).min(self.height - 1) * self.width + (column as usize).min(self.width - 1)
    }

    fn solid_angle(&self, pixel: usize) -> f64 {
        let row = pixel / self.width;
        TAU / self.width as f64 * (self.cos_above(row) - self.cos_above(row + 1))
    }

    /// Cosine of the angle from the zenith of a row's upper edge.
    fn cos_above(&self, row: usize) -> f64 {
        (PI * row as f64 / self.height as f64).cos()
    }
}
