// Light sources: what they send out, and points on them.

import package::gen::{LightRecord, MATERIAL_ONE_SIDED, MaterialRecord};
import package::lib::colour::{luminance};

// Radiance emitted towards where the ray came from.
fn emitted(material: MaterialRecord, from_behind: bool) -> vec3<f32> {
    let dark = from_behind && (material.flags & MATERIAL_ONE_SIDED) != 0u;
    return select(material.emission, vec3<f32>(0.0), dark);
}

// Density by area with which the points of such a light are drawn; `density` is that of unit luminance and one side.
fn light_area_pdf(emission: vec3<f32>, sides: u32, density: f32) -> f32 {
    return luminance(emission) * f32(sides) * density;
}

// A uniformly drawn point (Heitz 2019: A Low-Distortion Map Between Triangle and Square).
fn light_point(light: LightRecord, u: vec2<f32>) -> vec3<f32> {
    let half = 0.5 * min(u.x, u.y);
    let b = u - half;
    return light.a + b.x * (light.b - light.a) + b.y * (light.c - light.a);
}

// Weight of a direction drawn with density `own`, where another way draws it with density `other` (power heuristic of exponent
// 2; Veach 1997, section 9.2.4). `own` is above 0.
fn power_heuristic(own: f32, other: f32) -> f32 {
    // Bounded so that the square stays finite: what lies beyond weighs nothing.
    let ratio = min(other / own, 1e18);
    return 1.0 / (1.0 + ratio * ratio);
}
