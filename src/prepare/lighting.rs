//! Lights and sky to the parameters by which the trace kernel samples them.

use std::f64::consts::PI;

use glam::{Mat3, UVec2};

use crate::layout::trace::TraceParams;

/// What there is to sample lights from: sizes and powers of the kernel's tables.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lighting {
    /// Number of emitting triangles.
    pub lights: u32,
    /// 1 / the sum of their powers, as [`LightTable`](crate::layout::light::LightTable) has it; 0 without lights.
    pub light_density: f32,
    /// Pixels of the sky; zero without one.
    pub sky: UVec2,
    /// From directions of its picture to those of the scene: a rotation.
    pub sky_turn: Mat3,
    /// Integral of the sky's luminance over the sphere; 0 without one.
    pub sky_power: f64,
}

impl Lighting {
    /// The part of light samples that goes to emitting triangles, in a scene whose box is `radius` from its middle to a corner.
    /// Lights and sky are sampled by the power that each sends into the scene, but none more than nine times as often.
    pub fn light_share(&self, radius: f64) -> f32 {
        match (self.lights > 0, self.sky_power > 0.0) {
            (true, true) => {
                let light = PI / f64::from(self.light_density);
                let sky = PI * radius * radius * self.sky_power;
                (light / (light + sky)).clamp(0.1, 0.9) as f32
            }
            (false, true) => 0.0,
            _ => 1.0,
        }
    }

    /// Writes the lights, in a scene of such a `radius`.
    pub fn write(&self, params: &mut TraceParams, radius: f64) {
        params.light_share = self.light_share(radius);
        params.lights = self.lights;
        params.light_density = self.light_density * params.light_share;
        (params.sky_width, params.sky_height) = (self.sky.x, self.sky.y);
        (params.sky_x, params.sky_y, params.sky_z) = (self.sky_turn.x_axis, self.sky_turn.y_axis, self.sky_turn.z_axis);
        params.sky_density =
            if self.sky_power > 0.0 { ((1.0 - f64::from(params.light_share)) / self.sky_power) as f32 } else { 0.0 };
    }
}
