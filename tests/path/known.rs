//! Rooms whose answer is known.

use glam::{UVec2, Vec3};
use lucerna::layout::trace::{RadianceSample, TraceParams};

use crate::rooms::{Room, matte};
use crate::support;

use super::{furnace, inside, samples};

#[test]
fn every_size_is_traced_to_its_last_pixel() {
    let room = furnace(0.0, 2.0);
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    for (width, height) in [(1, 1), (3, 5), (7, 8), (8, 8), (9, 8), (8, 9), (17, 1)] {
        let params = TraceParams { layers: 3, ..inside(&room, UVec2::new(width, height), 4) };
        rig.upload("radiance", &vec![RadianceSample::default(); (width * height * 3) as usize]).unwrap();
        let right = RadianceSample { rgb: Vec3::splat(2.0), info: 1 };
        assert!(samples(&mut rig, &params).iter().all(|&s| s == right), "{width} x {height}");
    }
}

#[test]
fn few_triangles_make_a_picture() {
    for count in 0..4 {
        let mut room = Room { environment: Vec3::ONE, ..Room::default() };
        let grey = room.material(matte(Vec3::splat(0.5), Vec3::ZERO));
        for i in 0..count {
            let z = -0.1 * i as f32;
            room.triangle([Vec3::new(-1.0, -1.0, z), Vec3::new(1.0, -1.0, z), Vec3::new(0.0, 1.0, z)], grey);
        }
        let mut rig = support::rig();
        room.load(&mut rig).unwrap();
        let got = samples(&mut rig, &room.params(UVec2::splat(9)));
        let [corner, centre] = [got[0], got[4 * 9 + 4]];
        assert_eq!(corner, RadianceSample { rgb: Vec3::ONE, info: 1 });
        let hit = if count == 0 { (1.0, 1) } else { (0.5, 2) };
        assert_eq!(centre, RadianceSample { rgb: Vec3::splat(hit.0), info: hit.1 });
    }
}

#[test]
fn one_sided_light_leaves_the_front_only() {
    for one_sided in [false, true] {
        for (frame, e, f) in [(true, Vec3::X, Vec3::Y), (false, Vec3::Y, Vec3::X)] {
            let mut room = Room::default();
            let mut record = matte(Vec3::ZERO, Vec3::ONE);
            record.flags = u32::from(one_sided);
            let light = room.material(record);
            room.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * e, 2.0 * f, light);
            let mut rig = support::rig();
            room.load(&mut rig).unwrap();
            let got = samples(&mut rig, &room.params(UVec2::ONE))[0].rgb.x;
            assert_eq!(got, if frame || !one_sided { 1.0 } else { 0.0 }, "frame {frame}, one-sided {one_sided}");
        }
    }
}
