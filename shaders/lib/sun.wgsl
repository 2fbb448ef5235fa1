// The sun's disk: the directions whose unit vectors are nearer to its middle than a chord.

import package::lib::math::{frame_around, sin_cos_turns};

// Whether a unit direction is in the disk.
fn sun_covers(sun: vec3<f32>, chord_squared: f32, direction: vec3<f32>) -> bool {
    let offset = direction - sun;
    return dot(offset, offset) < chord_squared;
}

// A direction of the disk, uniform by solid angle. Unit length.
fn sun_point(sun: vec3<f32>, chord_squared: f32, u: vec2<f32>) -> vec3<f32> {
    // 1 - cos is uniform over a cone: half of the square of the chord.
    let depth = 0.5 * chord_squared * u.x;
    let sine = sqrt(depth * (2.0 - depth));
    let turn = sin_cos_turns(u.y);
    let frame = frame_around(sun);
    return (1.0 - depth) * sun + sine * (turn.y * frame.t + turn.x * frame.b);
}
