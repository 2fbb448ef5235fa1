//! The sun's disk in f64: the twin of `lib/sun`.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::layout::trace::TraceParams;

/// The disk, and how it is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisk {
    /// Its middle, unit length.
    direction: DVec3,
    chord_squared: f64,
    pub radiance: DVec3,
    /// Density by solid angle with which one of its directions is drawn.
    pub density: f64,
}

impl SunDisk {
    /// None where there is none.
    pub fn new(params: &TraceParams) -> Option<Self> {
        let chord_squared = f64::from(params.sun_chord_squared);
        let part = f64::from(params.sun_end) - f64::from(params.light_share);
        let sun = Self {
            direction: params.sun_direction.as_dvec3().normalize_or_zero(),
            chord_squared,
            radiance: params.sun_radiance.as_dvec3(),
            density: part / (PI * chord_squared),
        };
        (chord_squared > 0.0).then_some(sun)
    }

    /// Whether a unit direction is in it.
    pub fn covers(&self, direction: DVec3) -> bool {
        self.direction.distance_squared(direction) < self.chord_squared
    }

    /// One of its directions by two numbers in [0, 1): how far from the middle, and where around it.
    pub fn draw(&self, u: DVec2) -> DVec3 {
        let depth = 0.5 * self.chord_squared * u.x;
        let sine = (depth * (2.0 - depth)).sqrt();
        let (sin, cos) = (TAU * u.y).sin_cos();
        let n = self.direction;
        // Two unit vectors beside it (Duff et al., JCGT 6(1), 2017).
        let s = if n.z >= 0.0 { 1.0 } else { -1.0 };
        let a = -1.0 / (s + n.z);
        let b = n.x * n.y * a;
        let (t, b) = (DVec3::new(1.0 + s * n.x * n.x * a, s * b, -s * n.x), DVec3::new(b, s + n.y * n.y * a, -n.y));
        (1.0 - depth) * n + sine * (cos * t + sin * b)
    }
}
