//! Camera and film to the parameters of the trace kernel.

use glam::{DVec3, UVec2};

use crate::components::{Camera, Crop, TextureFilter};
use crate::layout::film::largest_sample;
use crate::layout::texture::{CAMERA_PART, CONE_PART};
use crate::layout::trace::TraceParams;

/// Writes the camera part, for a whole film of `film` pixels and a scene whose coordinates are relative to `origin`, in world
/// space. All in f64 until the last step, so that far from the world's origin nothing is lost.
///
/// The cone of a ray is that of a pinhole, wherever on the lens it begins: so it is right in the plane that is sharp. What is not sharp is
/// blurred by its samples, whose cones are as narrow as the sharp ones: noisier than a wide lookup, and not blurred twice.
pub fn aim(params: &mut TraceParams, camera: &Camera, film: UVec2, origin: DVec3) {
    let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
    let right = forward.cross(camera.up).normalize_or(forward.any_orthonormal_vector());
    let up = right.cross(forward);
    let tan = (camera.fov_y.to_radians() * 0.5).tan();
    let aspect = f64::from(film.x) / f64::from(film.y);
    params.position = (camera.position - origin).as_vec3();
    let shift = 2.0 * tan * (camera.lens.shift.x * right + camera.lens.shift.y * up);
    // A 0 that is added to -0 would make it another number.
    let middle = if shift == DVec3::ZERO { forward } else { forward + shift };
    params.forward = middle.as_vec3();
    params.focus = camera.focus_distance() as f32;
    // A camera that looks at its own place has no plane to be sharp in.
    params.lens_radius = if params.focus > 0.0 { camera.lens.aperture as f32 } else { 0.0 };
    params.right = (right * (tan * aspect)).as_vec3();
    params.up = (up * tan).as_vec3();
    params.cone_spread = (2.0 * tan / f64::from(film.y)) as f32;
    (params.film_width, params.film_height) = (film.x, film.y);
}

/// Writes how paths' cones grow, behind [`aim`].
pub fn set_footprint(params: &mut TraceParams, filter: TextureFilter) {
    match filter {
        TextureFilter::Footprint => {
            params.cone_spread *= CAMERA_PART;
            params.cone_part = CONE_PART;
        }
        TextureFilter::Exact => (params.cone_spread, params.cone_part) = (0.0, 0.0),
    }
}

/// Writes the rendered part of the film.
pub fn crop(params: &mut TraceParams, window: Crop) {
    let size = window.size();
    (params.window_x, params.window_y) = (window.min.x, window.min.y);
    (params.window_width, params.window_height) = (size.x, size.y);
}

/// Writes the largest radiance that a film of this exponent can hold.
pub fn fit_film(params: &mut TraceParams, exponent: i32) {
    params.largest = largest_sample(exponent);
}
