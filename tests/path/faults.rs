//! Samples that are no radiance, and where they say it began.

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::Camera;
use lucerna::gpu::Runtime;
use lucerna::layout::trace::{NO_MATERIAL, RadianceSample, SAMPLE_BAD, TraceParams};
use lucerna::prepare::camera;
use lucerna::shader::Library;

use crate::rooms::{Room, matte};
use crate::support;

use super::{furnace, inside, samples};

#[test]
fn bad_samples_say_where_they_went_wrong() {
    // A wall that emits NaN, seen directly or after a bounce off the others.
    for (value, kind) in [(f32::NAN, 1), (f32::INFINITY, 2), (-100.0, 3), (1e38, 4)] {
        let mut room = furnace(0.5, 1.0);
        let broken = room.material(matte(Vec3::ZERO, Vec3::splat(value)));
        room.triangles[8].material = broken;
        room.triangles[9].material = broken;
        let mut rig = support::rig();
        room.load(&mut rig);
        let size = UVec2::splat(16);
        let mut params = TraceParams { layers: 2, ..inside(&room, size, 3) };
        // Into the edge of the broken wall and a good one.
        let edge = DVec3::new(1.0, 0.0, -1.0);
        let view = Camera { position: DVec3::ZERO, look_at: edge, up: DVec3::Y, fov_y: 42.0, ..Camera::default() };
        camera::aim(&mut params, &view, size, DVec3::ZERO);
        camera::fit_film(&mut params, 40);
        let mut by_bounce = [0; 3];
        for sample in samples(&mut rig, &params) {
            if sample.info & SAMPLE_BAD == 0 {
                assert!(sample.rgb.is_finite() && sample.rgb.min_element() >= 0.0);
                continue;
            }
            let [got, bounce, material] = sample.rgb.to_array().map(|v| v as u32);
            assert_eq!((got, material), (kind, broken));
            assert_eq!(sample.info & !SAMPLE_BAD, bounce + 1, "rays up to the one that went wrong");
            by_bounce[bounce as usize] += 1;
        }
        assert!(by_bounce.iter().all(|&n| n > 0), "{by_bounce:?} of kind {kind}");
    }
    // The environment is no material.
    let room = Room { environment: Vec3::splat(1e30), ..Room::default() };
    let mut rig = support::rig();
    room.load(&mut rig);
    let mut params = room.params(UVec2::ONE);
    camera::fit_film(&mut params, 40);
    let sample = samples(&mut rig, &params)[0];
    assert_eq!(sample, RadianceSample { rgb: Vec3::new(4.0, 0.0, NO_MATERIAL as f32), info: 1 | SAMPLE_BAD });
}

#[test]
fn dim_light_is_no_overflow() {
    // The throughput of 1 is far above all radiance that such a film holds.
    let room = furnace(0.5, 1e-12);
    let mut rig = support::rig();
    room.load(&mut rig);
    let sample = samples(&mut rig, &inside(&room, UVec2::ONE, 2))[0];
    assert!(sample.info == 2 && (sample.rgb.x / 1.5e-12 - 1.0).abs() < 1e-5, "{sample:?}");
}

#[test]
fn a_broken_bsdf_is_reported_at_its_material() {
    let room = furnace(0.5, 1.0);
    let text = std::fs::read_to_string("shaders/lib/bsdf/mixture.wgsl").unwrap();
    // A NaN that is no constant, since that would be refused.
    let nan = "vec3<f32>(bitcast<f32>(0x7fc00000u + m.flags)), true";
    let broken = text.replace("m.kd, at.pdf > 0.0", nan);
    assert_ne!(text, broken);
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("lib/bsdf/mixture", &broken));
    room.load(&mut rig);
    for sample in samples(&mut rig, &inside(&room, UVec2::splat(4), 4)) {
        assert_eq!(sample, RadianceSample { rgb: Vec3::new(1.0, 0.0, 0.0), info: 1 | SAMPLE_BAD });
    }
}
