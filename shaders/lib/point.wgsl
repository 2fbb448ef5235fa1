// Point lights and spots: what they send in a direction.

import package::gen::{PointLightRecord};

// Radiant intensity in a direction of unit length, away from the light. Between two angles to its axis a spot falls off by the cubic
// t^2 (3 - 2 t) of the cosine (Pharr, Jakob and Humphreys: Physically Based Rendering, 4th edition, 12.2.1).
fn point_intensity(light: PointLightRecord, direction: vec3<f32>) -> vec3<f32> {
    let offset = direction - light.axis;
    // 1 - cos of the angle, which small angles don't cancel in: half of the square of the chord.
    let t = clamp((light.fade_end - 0.5 * dot(offset, offset)) * light.fade_scale, 0.0, 1.0);
    return light.intensity * (t * t * (3.0 - 2.0 * t));
}
