//! Point lights and spots to the rows that the light table has of them.

use glam::{DVec3, Vec3};

use crate::components::{PointLight, SpotCone};
use crate::layout::light::PointLightRecord;
use crate::layout::trace::luminance;

/// 1 - cos of the largest angle there is.
const EVERYWHERE: f64 = 2.0;

/// A light in a scene whose origin is at a point of world space. What is no number, and what can't be, is taken as its nearest bound.
///
/// A spot's light falls off from the inner cone to the outer one by the cubic `t^2 (3 - 2 t)` of the cosine (Pharr, Jakob and Humphreys,
/// "Physically Based Rendering", 4th edition, section 12.2.1). That is symmetric, so what is sent out in between is half of what it would
/// be without it, and the whole is 2 pi I (x + y) / 2 with 1 - cos of the inner angle and of the outer.
pub fn point_light(light: &PointLight, origin: DVec3) -> PointLightRecord {
    let intensity = light.intensity.map(|channel| if channel.is_finite() { channel.max(0.0) } else { 0.0 });
    let (axis, inner, outer) = match light.cone {
        None => (DVec3::ZERO, EVERYWHERE, EVERYWHERE),
        Some(cone) => {
            let [inner, outer] = depths(&cone);
            ((cone.look_at - light.position).normalize_or(DVec3::NEG_Y), inner, outer)
        }
    };
    let (fade_end, fade_scale) = match light.cone {
        // Half of the square of a unit vector is 1/2: before the light has begun to fade.
        None => (1.0, 4.0),
        Some(_) => (outer, 1.0 / (outer - inner).max(f64::from(f32::MIN_POSITIVE))),
    };
    // Nowhere: nothing is drawn of it.
    let there = if light.position.is_finite() { 1.0 } else { 0.0 };
    PointLightRecord {
        position: (light.position - origin).as_vec3(),
        axis: axis.as_vec3(),
        fade_end: fade_end as f32,
        fade_scale: fade_scale as f32,
        power: (there * f64::from(luminance(intensity)) * (inner + outer)) as f32,
        intensity,
        ..PointLightRecord::default()
    }
}

/// 1 - cos of the angles to the axis between which a spot's light falls off.
fn depths(cone: &SpotCone) -> [f64; 2] {
    let [least, most] = SpotCone::ANGLES;
    let half = 0.5 * if cone.angle.is_nan() { SpotCone::ANGLE } else { cone.angle.clamp(least, most) }.to_radians();
    let blend = if cone.blend.is_nan() { 0.0 } else { cone.blend.clamp(0.0, 1.0) };
    // 2 sin^2 of half the angle, which small angles don't cancel in.
    [(1.0 - blend) * half, half].map(|angle| 2.0 * (0.5 * angle).sin().powi(2))
}

/// What a film expects of point lights at most, for a scene in the box between two corners, relative to its origin: what the brightest sends to
/// where the scene is nearest to it, at 1/128 of its radius at least. A sample may be 2^16 times as bright: so a white surface fits that
/// is 1/32,768 of the radius away from a light among the scene.
pub fn brightest(lights: impl IntoIterator<Item = PointLightRecord>, low: Vec3, high: Vec3) -> f32 {
    let [low, high] = [low, high].map(|corner| corner.as_dvec3());
    let nearest = 0.5 * (high - low).length() / 128.0;
    let at = |light: PointLightRecord| {
        let position = light.position.as_dvec3();
        let away = (low - position).max(position - high).max(DVec3::ZERO).length();
        f64::from(light.intensity.max_element()) / away.max(nearest).powi(2)
    };
    let most = lights.into_iter().map(at).filter(|at| at.is_finite()).fold(0.0, f64::max);
    if most <= f64::from(f32::MAX) { most as f32 } else { 0.0 }
}
