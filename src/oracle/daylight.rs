//! A clear day: the sky by its model wherever it is asked, and the sun as the disk that it is.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use hw_skymodel::rgb::{Channel, SkyParams, SkyState};

use super::choice::luminance;
use super::random::Random;
use crate::components::Daylight;

/// W m^-2 sr^-1, as the eye weights it, in a radiance of 1.
const UNIT: f64 = 50.0;

/// Ozone's absorption from 450 to 770 nm, 1/m.
const OZONE: [f64; 33] = [
    0.3, 0.6, 0.9, 1.4, 2.1, 3.0, 4.0, 4.8, 6.3, 7.5, 8.5, 10.3, 12.0, 12.0, 11.5, 12.5, 12.0, 10.5, 9.0, 7.9, 6.7,
    5.7, 4.8, 3.6, 2.8, 2.3, 1.8, 1.4, 1.1, 1.0, 0.9, 0.7, 0.4,
];

pub struct Day {
    sky: Option<SkyState>,
    strength: f64,
    ground: DVec3,
    sun: DVec3,
    sun_radiance: DVec3,
    /// Half of the angle across the sun.
    sun_angle: f64,
}

impl Day {
    pub fn new(day: &Daylight) -> Self {
        let height = day.elevation.to_radians();
        let turn = DMat3::from_rotation_y(-day.azimuth.to_radians());
        let albedo = day.ground.to_array();
        let params = SkyParams { elevation: height as f32, turbidity: day.turbidity, albedo };
        let strength = f64::from(day.strength);
        let disk = |size: f64| 1.0 - (0.5 * size.to_radians()).cos();
        let arriving = strength * sunlight(height, f64::from(day.turbidity));
        let mut read = Self {
            sky: SkyState::new(&params).ok(),
            strength,
            ground: DVec3::ZERO,
            sun: turn * DVec3::new(0.0, height.sin(), -height.cos()),
            sun_radiance: arriving * (disk(0.533) / disk(day.sun_size)),
            sun_angle: 0.5 * day.sun_size.to_radians(),
        };
        const STEPS: u32 = 400;
        let mut irradiance = read.sun.y * arriving * TAU * disk(0.533);
        for i in 0..STEPS * STEPS {
            let [sin_squared, around] = [i % STEPS, i / STEPS].map(|i| (f64::from(i) + 0.5) / f64::from(STEPS));
            let (sin, angle) = (sin_squared.sqrt(), TAU * around);
            let direction = DVec3::new(sin * angle.cos(), (1.0 - sin_squared).sqrt(), sin * angle.sin());
            irradiance += PI / f64::from(STEPS * STEPS) * read.sky(direction);
        }
        read.ground = day.ground.as_dvec3() * irradiance / PI;
        read
    }

    /// Of sky or ground, without the sun.
    pub fn sky(&self, direction: DVec3) -> DVec3 {
        let Some(sky) = self.sky.as_ref() else { return DVec3::ZERO };
        if direction.y < 0.0 {
            return self.ground;
        }
        let (zenith, off) = (direction.angle_between(DVec3::Y) as f32, direction.angle_between(self.sun) as f32);
        let channels = [Channel::R, Channel::G, Channel::B];
        let radiance = channels.map(|channel| f64::from(sky.radiance(zenith, off, channel).max(0.0)));
        self.strength * DVec3::from_array(radiance) / UNIT
    }

    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let sun = if self.in_sun(direction) { self.sun_radiance } else { DVec3::ZERO };
        self.sky(direction) + sun
    }

    /// Integral of the sun's luminance over its disk.
    pub fn sun_power(&self) -> f64 {
        luminance(self.sun_radiance) * self.solid_angle()
    }

    /// Density of [`Day::draw_sun`], by solid angle.
    pub fn sun_pdf(&self, direction: DVec3) -> f64 {
        if self.in_sun(direction) { 1.0 / self.solid_angle() } else { 0.0 }
    }

    /// A direction evenly in the sun's disk.
    pub fn draw_sun(&self, random: &mut Random) -> DVec3 {
        let beside = self.sun.any_orthonormal_vector();
        let cos = 1.0 - random.unit() * (1.0 - self.sun_angle.cos());
        let (y, x) = (TAU * random.unit()).sin_cos();
        cos * self.sun + (1.0 - cos * cos).max(0.0).sqrt() * (x * beside + y * self.sun.cross(beside))
    }

    fn in_sun(&self, direction: DVec3) -> bool {
        self.sun.cross(direction).length().atan2(self.sun.dot(direction)) <= self.sun_angle
    }

    fn solid_angle(&self) -> f64 {
        TAU * (1.0 - self.sun_angle.cos())
    }
}

/// Radiance of the sun at its own size through the air, by every nanometre.
fn sunlight(height: f64, turbidity: f64) -> DVec3 {
    let path = 1.0 / (height.sin() + 0.15 * (height.to_degrees() + 3.885).powf(-1.253));
    let haze = (0.04608365822050 * turbidity - 0.04586025928522).max(0.0);
    let bell = |nm: f64, middle: f64, below: f64, above: f64| {
        (-0.5 * ((nm - middle) / if nm < middle { below } else { above }).powi(2)).exp()
    };
    let mut sum = DVec3::ZERO;
    for nm in (380..=780).map(f64::from) {
        let um = 1e-3 * nm;
        let ozone = match (nm as usize).checked_sub(450) {
            Some(past) if past < 320 => {
                let (i, part) = (past / 10, (past % 10) as f64 / 10.0);
                OZONE[i] + part * (OZONE[i + 1] - OZONE[i])
            }
            _ => 0.0,
        };
        let emitted = 119.1042972 / um.powi(5) / ((14387.769 / (5778.0 * um)).exp() - 1.0) * 1e3;
        let light = emitted * (-path * (0.008735 / um.powf(4.08) + haze / um.powf(1.3) + 0.0035 * ozone)).exp();
        let x = 1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7)
            - 0.065 * bell(nm, 501.1, 20.4, 26.2);
        let y = 0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1);
        let z = 1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8);
        sum += light * DVec3::new(x, y, z);
    }
    let to_rec709 = DMat3::from_cols_array(&[
        3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252,
    ]);
    (to_rec709 * sum).max(DVec3::ZERO) / UNIT
}
