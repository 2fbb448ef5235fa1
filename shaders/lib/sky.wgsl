// Directions and the pixels of an environment by longitude and latitude: its middle is towards -z, its top towards +y, its right half
// towards +x.

import package::lib::math::{sin_cos_turns, turns_of};

// Column and row of the pixel in a unit direction.
fn sky_cell(direction: vec3<f32>, size: vec2<u32>) -> vec2<u32> {
    let across = 0.5 + turns_of(-direction.z, direction.x);
    let down = 2.0 * turns_of(direction.y, length(direction.xz));
    return min(vec2<u32>(vec2<f32>(across, down) * vec2<f32>(size)), size - 1u);
}

// A direction within a pixel, uniform by solid angle. Unit length.
fn sky_direction(cell: vec2<u32>, size: vec2<u32>, u: vec2<f32>) -> vec3<f32> {
    let turn = sin_cos_turns((f32(cell.x) + u.x) / f32(size.x));
    let rows = vec2<f32>(f32(cell.y), f32(cell.y + 1u)) / (2.0 * f32(size.y));
    // Towards +y the cosine of the angle has lost its digits; the sine of half the angle has not.
    let upper = sin_cos_turns(0.5 * rows.x).x;
    let lower = sin_cos_turns(0.5 * rows.y).x;
    let half_squared = mix(upper * upper, lower * lower, u.y);
    let sine = 2.0 * sqrt(half_squared * (1.0 - half_squared));
    return vec3<f32>(-turn.x * sine, 1.0 - 2.0 * half_squared, turn.y * sine);
}
