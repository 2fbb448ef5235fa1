//! Lights and sky to the parameters by which the trace kernel samples them.

use std::f64::consts::PI;

use glam::{Mat3, UVec2};

use crate::layout::sky::Sun;
use crate::layout::trace::{TraceParams, luminance};

/// What there is to sample lights from: sizes and powers of the kernel's tables.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lighting {
    /// Number of lights in their table: emitting triangles and point lights.
    pub lights: u32,
    /// 1 / the sum of their powers, as [`LightTable`](crate::layout::light::LightTable) has it; 0 without lights.
    pub light_density: f32,
    /// The table has point lights alone: triangles are left to be hit.
    pub points_alone: bool,
    /// Pixels of the sky; zero without one.
    pub sky: UVec2,
    /// From directions of its picture to those of the scene: a rotation.
    pub sky_turn: Mat3,
    /// Integral of the sky's luminance over the sphere; 0 without one.
    pub sky_power: f64,
    /// Beside the sky's picture, and sampled if that is.
    pub sun: Option<Sun>,
}

impl Lighting {
    /// The part of light samples that goes to triangles and point lights, in a scene whose box is `radius` from its middle to a corner.
    /// Lights and sky are sampled by the power that each sends into the scene, but none more than nine times as often.
    pub fn light_share(&self, radius: f64) -> f32 {
        match (self.lights > 0, self.sky_power > 0.0) {
            (true, true) => {
                let light = PI / f64::from(self.light_density);
                let sky = PI * radius * radius * (self.sky_power + self.sun_power());
                (light / (light + sky)).clamp(0.1, 0.9) as f32
            }
            (false, true) => 0.0,
            _ => 1.0,
        }
    }

    /// Integral of the sun's luminance over its disk; 0 where it is not sampled.
    fn sun_power(&self) -> f64 {
        let sun = self.sun.filter(|_| self.sky_power > 0.0);
        sun.map_or(0.0, |sun| f64::from(luminance(sun.radiance)) * sun.solid_angle())
    }

    /// Where the sun's part of light samples ends, which begins at `light_share`: of those that are of sun or sky, by their power.
    fn sun_end(&self, light_share: f32) -> f32 {
        match self.sun_power() {
            power if power > 0.0 => {
                let part = (power / (power + self.sky_power)).clamp(0.1, 0.9);
                light_share + (1.0 - light_share) * part as f32
            }
            _ => light_share,
        }
    }

    /// Writes the lights, in a scene of such a `radius`.
    pub fn write(&self, params: &mut TraceParams, radius: f64) {
        params.light_share = self.light_share(radius);
        params.lights = self.lights;
        params.point_density = self.light_density * params.light_share;
        params.light_density = if self.points_alone { 0.0 } else { params.point_density };
        (params.sky_width, params.sky_height) = (self.sky.x, self.sky.y);
        (params.sky_x, params.sky_y, params.sky_z) = (self.sky_turn.x_axis, self.sky_turn.y_axis, self.sky_turn.z_axis);
        params.sun_end = self.sun_end(params.light_share);
        params.sky_density =
            if self.sky_power > 0.0 { ((1.0 - f64::from(params.sun_end)) / self.sky_power) as f32 } else { 0.0 };
        if let Some(sun) = self.sun {
            (params.sun_direction, params.sun_radiance) = (sun.direction, sun.radiance);
            params.sun_chord_squared = sun.chord_squared;
            let part = f64::from(params.sun_end) - f64::from(params.light_share);
            params.sun_density = (part / sun.solid_angle()) as f32;
        }
    }
}
