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

/// What a film expects of point lights at most: `NEAR` times what the brightest one sends over the scene's own `radius`. So a white surface
/// fits that is a thousandth of the radius away, and nearer ones by as much room as films leave above what they expect. A step of the film
/// is far below the light at that radius.
pub fn brightest(lights: impl IntoIterator<Item = PointLightRecord>, radius: f64) -> f32 {
    let most = lights.into_iter().fold(Vec3::ZERO, |most, light| most.max(light.intensity)).max_element();
    let at = NEAR * f64::from(most) / (radius * radius);
    if at.is_finite() { at as f32 } else { 0.0 }
}

/// By so much a surface that is 1/1024 of the scene's radius from a light is brighter than one at that radius.
const NEAR: f64 = 1_048_576.0;
