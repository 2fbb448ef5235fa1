//! What the device is given, made from components.

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Camera, Crop};
use lucerna::layout::film::largest_sample;
use lucerna::layout::trace::TraceParams;
use lucerna::prepare::camera;
use lucerna::prepare::lighting::Lighting;

fn aimed(camera: &Camera, origin: DVec3) -> TraceParams {
    let mut params = TraceParams::default();
    camera::aim(&mut params, camera, UVec2::new(200, 100), origin);
    params
}

#[test]
fn a_camera_spans_its_field_of_view() {
    let camera = Camera {
        position: DVec3::new(0.0, 0.0, 3.0),
        look_at: DVec3::ZERO,
        up: DVec3::Y,
        fov_y: 90.0,
        ..Camera::default()
    };
    let params = aimed(&camera, DVec3::ZERO);
    assert_eq!((params.position, params.forward), (Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z));
    assert!(params.up.distance(Vec3::Y) < 1e-6 && params.right.distance(2.0 * Vec3::X) < 1e-6);
    assert!((params.cone_spread - 0.02).abs() < 1e-8, "an edge of a pixel, one unit away");
    assert_eq!((params.film_width, params.film_height), (200, 100));
}

#[test]
fn a_camera_far_from_the_origin_loses_nothing() {
    let far = DVec3::splat(1e9);
    let near = Camera {
        position: DVec3::new(0.1, 0.2, 0.3),
        look_at: DVec3::ONE,
        up: DVec3::Y,
        fov_y: 40.0,
        ..Camera::default()
    };
    let there = Camera { position: near.position + far, look_at: near.look_at + far, ..near };
    let (here, there) = (aimed(&near, DVec3::ZERO), aimed(&there, far));
    assert!(here.position.distance(there.position) < 1e-6 && here.forward.distance(there.forward) < 1e-6);
}

#[test]
fn a_camera_without_a_direction_still_has_one() {
    let blind = Camera { position: DVec3::ONE, look_at: DVec3::ONE, up: DVec3::Y, fov_y: 40.0, ..Camera::default() };
    assert_eq!(aimed(&blind, DVec3::ZERO).forward, Vec3::NEG_Z);
    let along = Camera { look_at: DVec3::new(1.0, 2.0, 1.0), ..blind };
    let params = aimed(&along, DVec3::ZERO);
    assert!(params.right.is_finite() && params.right.length() > 0.1 && params.right.dot(Vec3::Y).abs() < 1e-6);
}

#[test]
fn a_crop_and_an_exponent_are_written() {
    let mut params = TraceParams::default();
    camera::crop(&mut params, Crop { min: UVec2::new(3, 5), max: UVec2::new(10, 25) });
    assert_eq!([params.window_x, params.window_y, params.window_width, params.window_height], [3, 5, 7, 20]);
    camera::fit_film(&mut params, 12);
    assert_eq!(params.largest, largest_sample(12));
}

#[test]
fn light_samples_go_where_the_power_is() {
    let lights = Lighting { lights: 2, light_density: 0.25, ..Lighting::default() };
    let sky = Lighting { sky: UVec2::new(8, 4), sky_power: 4.0, ..Lighting::default() };
    let both = Lighting { sky: sky.sky, sky_power: sky.sky_power, ..lights };
    assert_eq!([Lighting::default(), lights, sky].map(|lighting| lighting.light_share(1.0)), [1.0, 1.0, 0.0]);
    // Powers of 4 pi each, then one far above the other.
    assert_eq!([1.0, 100.0, 0.01].map(|radius| both.light_share(radius)), [0.5, 0.1, 0.9]);
    let mut params = TraceParams::default();
    both.write(&mut params, 1.0);
    assert_eq!((params.lights, params.light_density, params.light_share), (2, 0.125, 0.5));
    assert_eq!((params.sky_width, params.sky_height, params.sky_density), (8, 4, 0.125));
}
