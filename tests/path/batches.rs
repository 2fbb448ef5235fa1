//! A sample is a function of seed, pixel and number alone.

use glam::UVec2;
use lucerna::components::Crop;
use lucerna::layout::trace::TraceParams;
use lucerna::passes::lattice::{corners, refinement};
use lucerna::prepare::camera;

use crate::rooms::Room;
use crate::support;

use super::samples;

#[test]
fn samples_do_not_depend_on_batch_or_crop() {
    let room = Room { roulette: true, ..Room::cornell() };
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    let params = TraceParams { layers: 6, ..room.params(UVec2::new(21, 13)) };
    let whole = samples(&mut rig, &params);
    let pixels = (params.window_width * params.window_height) as usize;
    assert!(whole == samples(&mut rig, &params), "the same seed gave other samples");
    assert!(whole != samples(&mut rig, &TraceParams { seed: 2, ..params }), "another seed gave the same samples");
    for (first, layers) in [(0u32, 1u32), (1, 2), (3, 3)] {
        let part = samples(&mut rig, &TraceParams { first_sample: first, layers, ..params });
        assert!(part == whole[first as usize * pixels..][..layers as usize * pixels], "a cut at {first}");
    }
    for (min, max) in [((0, 0), (1, 1)), ((5, 3), (16, 12)), ((20, 12), (21, 13))] {
        let (min, max) = (UVec2::from(min), UVec2::from(max));
        let mut cropped = params;
        camera::crop(&mut cropped, Crop { min, max });
        let size = max - min;
        for (i, sample) in samples(&mut rig, &cropped).into_iter().enumerate() {
            let i = i as u32;
            let (layer, x, y) = (i / (size.x * size.y), i % size.x, i / size.x % size.y);
            let at = (layer * params.window_height + y + min.y) * params.window_width + x + min.x;
            assert_eq!(sample, whole[at as usize], "crop {min} to {max}, pixel {x}, {y}, layer {layer}");
        }
    }
    for level in [1, 2, 5] {
        for lattice in [corners(level), refinement(level)] {
            let size = lattice.size(UVec2::new(21, 13));
            let part = TraceParams {
                window_x: params.window_x + lattice.first.x,
                window_y: params.window_y + lattice.first.y,
                window_width: size.x,
                window_height: size.y,
                column_shift: lattice.shift.x,
                row_shift: lattice.shift.y,
                ..params
            };
            for (i, sample) in samples(&mut rig, &part).into_iter().enumerate() {
                let i = i as u32;
                let at = lattice.first + (UVec2::new(i % size.x, i / size.x % size.y) << lattice.shift);
                let at = (i / (size.x * size.y) * 13 + at.y) * 21 + at.x;
                assert_eq!(sample, whole[at as usize], "{lattice:?}, sample {i}");
            }
        }
    }
}
