// Light sources: what they send out, and points on them.

import package::gen::{LightRecord, MATERIAL_ONE_SIDED, MaterialRecord};

// Radiance emitted towards where the ray came from.
fn emitted(material: MaterialRecord, back_face: bool) -> vec3<f32> {
    let dark = back_face && (material.flags & MATERIAL_ONE_SIDED) != 0u;
    return select(material.emission, vec3<f32>(0.0), dark);
}

// Density by area with which the points of a light of such a luminance are drawn; `density` is that of unit luminance and one side.
fn light_area_pdf(luminance: f32, sides: u32, density: f32) -> f32 {
    return luminance * f32(sides) * density;
}

// Weights of the second and third corner of a uniformly drawn point (Heitz 2019: A Low-Distortion Map Between Triangle and Square).
fn light_weights(u: vec2<f32>) -> vec2<f32> {
    return u - 0.5 * min(u.x, u.y);
}

// The point of a light with such weights.
fn light_point(light: LightRecord, b: vec2<f32>) -> vec3<f32> {
    return light.a + b.x * (light.b - light.a) + b.y * (light.c - light.a);
}

// A point of a light moved towards the middle, so far that a ray to it hits the light however it is rounded: by a millionth of what a
// lamp is wide, and up to the middle itself of a light that is a speck from there. `reach` is the way to it and its coordinates, added.
fn kept_from_edges(light: LightRecord, point: vec3<f32>, reach: f32) -> vec3<f32> {
    let middle = (light.a + light.b + light.c) / 3.0;
    return mix(point, middle, min(abs(light.shrink) * reach, 1.0));
}

// Weight of a direction drawn with density `own`, where another way draws it with density `other` (power heuristic of exponent
// 2; Veach 1997, section 9.2.4). `own` is above 0.
fn power_heuristic(own: f32, other: f32) -> f32 {
    // Bounded so that the square stays finite: what lies beyond weighs nothing.
    let ratio = min(other / own, 1e18);
    return 1.0 / (1.0 + ratio * ratio);
}
