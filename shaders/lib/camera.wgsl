// Pinhole camera.

import package::gen::{TraceParams};

// Unit direction through a point of the whole film, in pixels from its top left corner.
fn camera_direction(camera: TraceParams, at: vec2<f32>) -> vec3<f32> {
    let sx = 2.0 * at.x / f32(camera.film_width) - 1.0;
    let sy = 1.0 - 2.0 * at.y / f32(camera.film_height);
    return normalize(camera.forward + sx * camera.right + sy * camera.up);
}
