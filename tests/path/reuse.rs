//! Paths that are reused within tiles: against the twin, and against paths that are not.

use std::collections::HashMap;

use glam::{DVec3, UVec2};
use lucerna::cpu::path::Traced;
use lucerna::cpu::rng::Source;
use lucerna::gpu::Runtime;
use lucerna::layout::trace::{RadianceSample, SAMPLE_BAD, TILE_BLOCK, TraceParams};
use lucerna::shader::Library;

use crate::rooms::{Room, trace_reused_batch};
use crate::support;
use crate::support::plant::plant;

use super::{batch, block_sums, compare, kernel, small};

/// The samples of a batch of whole blocks.
fn reused_samples(rig: &mut Runtime, params: &TraceParams) -> Vec<RadianceSample> {
    trace_reused_batch(rig, params, false);
    let count = params.window_width * params.window_height * params.layers;
    rig.read_some("radiance", count as usize).unwrap()
}

/// The two kernels' sums of batch `i`.
fn reusing(room: &Room, library: Library, params: &TraceParams) -> impl FnMut(usize) -> Vec<(DVec3, u64)> {
    let (mut rig, params) = (Runtime::new(support::gpu(), library), *params);
    Room { reuse: true, ..room.clone() }.load(&mut rig);
    move |i| {
        let params = batch(&params, i);
        let got = reused_samples(&mut rig, &params);
        block_sums(&params, |layer, p| {
            let sample = got[((layer * params.window_height + p.y) * params.window_width + p.x) as usize];
            assert_eq!(sample.info & SAMPLE_BAD, 0, "a bad sample at {p}, layer {layer}: {sample:?}");
            (sample.rgb.as_dvec3(), sample.info)
        })
    }
}

/// The twin's sums of batch `i`, block by block.
fn twin_reusing(room: &Room, params: &TraceParams) -> impl Fn(usize) -> Vec<(DVec3, u64)> {
    let (twin, params) = (room.twin(), *params);
    move |i| {
        let params = batch(&params, i);
        let mut traced: HashMap<(u32, UVec2), Traced> = HashMap::new();
        for layer in 0..params.layers {
            for first in first_pixels(&params) {
                let block = twin.sample_block(&params, first, params.first_sample + layer);
                traced.extend(block.into_iter().map(|(pixel, sample)| ((layer, pixel), sample)));
            }
        }
        block_sums(&params, |layer, pixel| (traced[&(layer, pixel)].radiance, traced[&(layer, pixel)].rays))
    }
}

/// The first pixel of every block of a film.
fn first_pixels(params: &TraceParams) -> Vec<UVec2> {
    let of = |length: u32| (0..length).step_by(TILE_BLOCK as usize);
    of(params.film_height).flat_map(|y| of(params.film_width).map(move |x| UVec2::new(x, y))).collect()
}

fn rooms() -> [(&'static str, Room); 4] {
    let asked = |room: Room| Room { next_event: true, roulette: true, sampler: Source::Sobol, ..room };
    [
        ("cornell", asked(Room::cornell())),
        ("cornell, independent numbers", Room { sampler: Source::Pcg, roulette: false, ..asked(Room::cornell()) }),
        ("lights are hit", Room { next_event: false, ..asked(Room::cornell()) }),
        ("glass", asked(Room::glass())),
    ]
}

#[test]
fn equals_the_f64_twin() {
    for (name, room) in rooms() {
        // Neither side is one of whole blocks: tiles at the film's edge lack pixels.
        let params = TraceParams { layers: 4, ..room.params(UVec2::new(27, 21)) };
        compare(reusing(&room, Library::shipped(), &params), twin_reusing(&room, &params))
            .unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

#[test]
fn finds_what_paths_of_their_own_find() {
    for (name, room) in rooms() {
        compare_with_own(&room, Library::shipped()).unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

/// Whether reused paths find the same as others, on other random numbers.
fn compare_with_own(room: &Room, library: Library) -> Result<(), String> {
    // One block, whose pixels see all of the room: 820,000 paths each.
    let layers = if support::stress() { 1024 } else { 400 };
    let params = TraceParams { layers, seed: 1, ..room.params(UVec2::splat(8)) };
    let own = TraceParams { seed: 2, ..params };
    compare(reusing(room, library, &params), kernel(room, Library::shipped(), &own))
}

#[test]
fn what_is_wrong_with_the_weights_is_seen() {
    let room = Room { next_event: true, ..Room::cornell() };
    let params = TraceParams { layers: 4, ..small(&room) };
    let sums: Vec<_> = (0..crate::statistics::BATCHES).map(twin_reusing(&room, &params)).collect();
    let unseen_counts = [
        ("density = select(0.0, link.pdf,", "density = select(-link.pdf, link.pdf,"),
        ("total += densities[local * TILE_PIXELS + m];", "total += abs(densities[local * TILE_PIXELS + m]);"),
    ];
    let by_two_percent =
        [("density = select(0.0, link.pdf,", "density = select(0.0, link.pdf * select(1.0, 1.02, slot == 5u),")];
    let too_bright = [("link.value = at.value * by_area;", "link.value = 1.01 * at.value * by_area;")];
    for wrong in [&unseen_counts[..], &by_two_percent, &too_bright] {
        let library = wrong
            .iter()
            .fold(Library::shipped(), |library, (right, wrong)| plant(library, "passes/trace/gather", right, wrong));
        let seen = compare(reusing(&room, library, &params), |i| sums[i].clone());
        assert!(seen.is_err(), "{wrong:?} went unnoticed");
    }
}
