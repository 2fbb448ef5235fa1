//! Samples that are no radiance, and where they say it began.

use glam::{UVec2, Vec3};
use lucerna::gpu::Runtime;
use lucerna::layout::trace::{NO_MATERIAL, RadianceSample, SAMPLE_BAD};
use lucerna::prepare::camera;
use lucerna::shader::Library;

use crate::rooms::Room;
use crate::support;

use super::{furnace, inside, samples};

#[test]
fn light_of_the_environment_that_is_too_much_is_of_no_material() {
    let room = Room { environment: Vec3::splat(1e30), ..Room::default() };
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
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
    room.load(&mut rig).unwrap();
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
    room.load(&mut rig).unwrap();
    for sample in samples(&mut rig, &inside(&room, UVec2::splat(4), 4)) {
        assert_eq!(sample, RadianceSample { rgb: Vec3::new(1.0, 0.0, 0.0), info: 1 | SAMPLE_BAD });
    }
}
