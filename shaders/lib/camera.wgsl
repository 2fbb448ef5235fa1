// Cameras: a pinhole, and a thin lens about it.

import package::gen::{TraceParams};
@if(lens) import package::lib::sampling::{concentric_disk};

// From the middle of the lens through a point of the whole film, in pixels from its top left corner; of length 1 along the viewing axis.
fn through_film(camera: TraceParams, at: vec2<f32>) -> vec3<f32> {
    let sx = 2.0 * at.x / f32(camera.film_width) - 1.0;
    let sy = 1.0 - 2.0 * at.y / f32(camera.film_height);
    return camera.forward + sx * camera.right + sy * camera.up;
}

// The same of unit length.
fn camera_direction(camera: TraceParams, at: vec2<f32>) -> vec3<f32> {
    return normalize(through_film(camera, at));
}

// Where a ray begins, and its unit direction.
@if(lens)
struct LensRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
}

// The ray from a point of the lens, even in `u`, to where the middle of the lens sees that point of the film sharp. All points of the lens count alike.
@if(lens)
fn lens_ray(camera: TraceParams, at: vec2<f32>, u: vec2<f32>) -> LensRay {
    let point = camera.lens_radius * concentric_disk(u);
    let offset = point.x * normalize(camera.right) + point.y * normalize(camera.up);
    return LensRay(camera.position + offset, normalize(through_film(camera, at) - offset / camera.focus));
}
