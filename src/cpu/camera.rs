//! Rays of the camera: a pinhole, and a thin lens about it. The twin of `lib/camera`.

use glam::{DVec2, DVec3};

use crate::layout::trace::TraceParams;

/// From the middle of the lens through a point of the whole film, in pixels from its top left corner; of length 1 along the viewing axis.
pub fn through_film(params: &TraceParams, at: DVec2) -> DVec3 {
    let size = DVec2::new(f64::from(params.film_width), f64::from(params.film_height));
    let s = (2.0 * at / size - 1.0) * DVec2::new(1.0, -1.0);
    params.forward.as_dvec3() + s.x * params.right.as_dvec3() + s.y * params.up.as_dvec3()
}

/// Origin and unit direction of the ray through a point of the film, from a point of the lens that is even in `u`; that is not asked for
/// by a pinhole.
pub fn camera_ray(params: &TraceParams, at: DVec2, u: impl FnOnce() -> DVec2) -> (DVec3, DVec3) {
    let (middle, sharp) = (params.position.as_dvec3(), through_film(params, at));
    if params.lens_radius <= 0.0 {
        return (middle, sharp.normalize());
    }
    let point = f64::from(params.lens_radius) * concentric_disk(u());
    let [right, up] = [params.right, params.up].map(|side| side.as_dvec3().normalize());
    let offset = point.x * right + point.y * up;
    (middle + offset, (sharp - offset / f64::from(params.focus)).normalize())
}

/// A point of the unit disk, evenly: squares about the middle become circles.
pub fn concentric_disk(u: DVec2) -> DVec2 {
    let p = 2.0 * u - 1.0;
    let (radius, turn) = match p {
        DVec2::ZERO => return DVec2::ZERO,
        _ if p.x.abs() > p.y.abs() => (p.x, 0.125 * p.y / p.x),
        _ => (p.y, 0.25 - 0.125 * p.x / p.y),
    };
    radius * DVec2::from_angle(turn * std::f64::consts::TAU)
}
