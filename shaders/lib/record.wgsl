// What code notes of the ray that a path is at, where the path is replayed (passes/trace/replay). Everywhere else there is nothing of it.

import package::gen::{PathTurn, TURN_LIGHT};

// Of the ray that was traced last.
var<private> turn: PathTurn;

// A light was sampled by the point `u`; the surface sends on `value`, f * cos, and would have drawn its direction with `bsdf_pdf`.
fn note_light(u: vec2<f32>, direction: vec3<f32>, pdf: f32, radiance: vec3<f32>, triangle: u32, value: vec3<f32>, bsdf_pdf: f32) {
    turn.done |= TURN_LIGHT;
    turn.light_u = u;
    turn.light_direction = direction;
    turn.light_pdf = pdf;
    turn.light_radiance = radiance;
    turn.light_triangle = triangle;
    turn.light_value = value;
    turn.light_bsdf_pdf = bsdf_pdf;
}
