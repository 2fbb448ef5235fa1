//! The environment: radiance by direction, and directions by radiance.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::choice::{Distribution, luminance};
use super::daylight::Day;
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
    /// A day, of which the pixels are what is expected; radiance is its own.
    day: Option<Day>,
    /// Probability of drawing its sun.
    sun_chance: f64,
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
            Environment::Daylight(day) => {
                let read = Day::new(day);
                let sky = Self { width: 256, height: 128, ..Self::empty() };
                let pixels = (0..sky.width * sky.height).map(|pixel| read.sky(sky.middle(pixel))).collect();
                return sky.fill(pixels, Some(read));
            }
        };
        Self { width, height, turn, ..Self::empty() }.fill(pixels, None)
    }

    fn empty() -> Self {
        let choice = Distribution::default();
        Self { width: 1, height: 1, pixels: Vec::new(), turn: DMat3::IDENTITY, choice, day: None, sun_chance: 0.0 }
    }

    fn fill(mut self, pixels: Vec<DVec3>, day: Option<Day>) -> Self {
        let powers: Vec<f64> = pixels.iter().enumerate().map(|(i, p)| luminance(*p) * self.solid_angle(i)).collect();
        let all: f64 = powers.iter().sum();
        self.sun_chance = day.as_ref().map_or(0.0, |day| day.sun_power() / (day.sun_power() + all).max(1e-300));
        self.choice = Distribution::new(powers.into_iter());
        self.pixels = pixels;
        self.day = day;
        self
    }

    pub fn is_black(&self) -> bool {
        self.choice.is_empty()
    }

    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        self.day.as_ref().map_or_else(|| self.pixels[self.pixel_at(direction)], |day| day.radiance(direction))
    }

    /// Density of [`Sky::draw`], by solid angle.
    pub fn pdf(&self, direction: DVec3) -> f64 {
        let pixel = self.pixel_at(direction);
        let sun = self.day.as_ref().map_or(0.0, |day| day.sun_pdf(direction));
        self.sun_chance * sun + (1.0 - self.sun_chance) * self.choice.chance(pixel) / self.solid_angle(pixel)
    }

    /// A direction of the sun, or a pixel by its power and a direction evenly in its solid angle.
    pub fn draw(&self, random: &mut Random) -> DVec3 {
        if let Some(day) = self.day.as_ref()
            && random.unit() < self.sun_chance
        {
            return day.draw_sun(random);
        }
        let pixel = self.choice.draw(random.unit());
        let (row, column) = (pixel / self.width, pixel % self.width);
        let (low, high) = (self.cos_above(row + 1), self.cos_above(row));
        let cos = low + (high - low) * random.unit();
        let turn = (column as f64 + random.unit()) / self.width as f64 - 0.5;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.turn * DVec3::new(sin * (TAU * turn).sin(), cos, -sin * (TAU * turn).cos())
    }

    fn middle(&self, pixel: usize) -> DVec3 {
        let angle = PI * ((pixel / self.width) as f64 + 0.5) / self.height as f64;
        let turn = TAU * (((pixel % self.width) as f64 + 0.5) / self.width as f64 - 0.5);
        DVec3::new(angle.sin() * turn.sin(), angle.cos(), -angle.sin() * turn.cos())
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
