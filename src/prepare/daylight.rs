//! The sky of a clear day to a picture: after Hosek and Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance" (2012), by
//! their own coefficients for linear sRGB, whose primaries are Rec.709's. The library that holds these carries their licence
//! (3-clause BSD, Hosek and Wilkie).

use std::f64::consts::PI;

use glam::{DVec3, UVec2, Vec3};
use hw_skymodel::rgb::{Channel, SkyParams, SkyState};

use super::sun::{UNIT, elevation, solid_angle, sun_radiance};
use crate::components::Daylight;

/// Pixels of the picture.
pub const SIZE: UVec2 = UVec2::new(512, 256);

/// Radiance by longitude and latitude without the sun's disk, row by row from the top, the sun's azimuth in the middle. Below the
/// horizon is the ground, lit by sky and sun.
pub fn sky_pixels(day: &Daylight) -> Vec<Vec3> {
    let params = SkyParams {
        elevation: elevation(day) as f32,
        turbidity: day.turbidity.clamp(1.0, 10.0),
        albedo: day.ground.clamp(Vec3::ZERO, Vec3::ONE).to_array(),
    };
    // Numbers that are none give no light.
    let Ok(state) = SkyState::new(&params) else { return vec![Vec3::ZERO; (SIZE.x * SIZE.y) as usize] };
    let sun = DVec3::new(0.0, elevation(day).sin(), -elevation(day).cos());
    let scale = day.strength / UNIT as f32;
    let mut pixels = Vec::with_capacity((SIZE.x * SIZE.y) as usize);
    // From the sky, on level ground.
    let mut irradiance = DVec3::ZERO;
    for y in 0..SIZE.y / 2 {
        let zenith = PI * (f64::from(y) + 0.5) / f64::from(SIZE.y);
        let weight = zenith.cos() * zenith.sin() * (PI / f64::from(SIZE.y)) * (2.0 * PI / f64::from(SIZE.x));
        for x in 0..SIZE.x {
            let turn = 2.0 * PI * ((f64::from(x) + 0.5) / f64::from(SIZE.x) - 0.5);
            let direction = DVec3::new(zenith.sin() * turn.sin(), zenith.cos(), -zenith.sin() * turn.cos());
            let (zenith, off) = (zenith as f32, direction.angle_between(sun) as f32);
            let channel = |channel| state.radiance(zenith, off, channel).max(0.0);
            let radiance = scale * Vec3::new(channel(Channel::R), channel(Channel::G), channel(Channel::B));
            irradiance += weight * radiance.as_dvec3();
            pixels.push(radiance);
        }
    }
    irradiance += sun.y * f64::from(day.strength) * sun_radiance(day) * solid_angle(Daylight::SUN_SIZE);
    let ground = (day.ground.as_dvec3() * irradiance / PI).as_vec3();
    pixels.resize((SIZE.x * SIZE.y) as usize, ground);
    pixels
}
