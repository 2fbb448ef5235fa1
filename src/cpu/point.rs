//! Point lights and spots in f64: the twin of `lib/point`.

use glam::DVec3;

use crate::layout::light::PointLightRecord;

/// Radiant intensity in a direction of unit length, away from the light.
pub fn point_intensity(light: &PointLightRecord, direction: DVec3) -> DVec3 {
    let depth = 0.5 * direction.distance_squared(light.axis.as_dvec3());
    let t = ((f64::from(light.fade_end) - depth) * f64::from(light.fade_scale)).clamp(0.0, 1.0);
    light.intensity.as_dvec3() * (t * t * (3.0 - 2.0 * t))
}
