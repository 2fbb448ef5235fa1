//! The path kernel against its f64 twin, and in rooms whose answer is known.

mod batches;
mod corners;
mod faults;
mod known;
mod means;
mod reuse;
mod twin;
mod visibility;

use std::collections::BTreeSet;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Energy, Material, Passage};
use lucerna::cpu::rng::Source;
use lucerna::gpu::Runtime;
use lucerna::layout::texture::MaterialMaps;
use lucerna::layout::trace::{RadianceSample, SAMPLE_BAD, TraceParams};
use lucerna::passes::trace::Needs;
use lucerna::prepare::material;
use lucerna::shader::Library;

use crate::rooms::{Room, matte, shiny, trace_batch};
use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;
use crate::support::plant::planted;

/// Pixels of a side of a block whose mean is compared.
const BLOCK: u32 = 8;

#[test]
fn a_scene_can_ask_for_every_feature_that_the_kernel_names() {
    let pack = |values: Material| material::pack(&values, Energy::Preserve);
    let mut room = Room { roulette: true, reuse: true, next_event: true, sampler: Source::Sobol, ..Room::glass() };
    room.material(shiny(Vec3::ZERO, Vec3::ONE, 1.0));
    room.material(pack(Material { coat: 1.0, ..Material::BLACK }));
    room.material(pack(Material { passage: Passage::Pane(1.5), ..Material::BLACK }));
    let library = Library::embedded();
    let named = library.link("passes/trace/path", &library.features().unwrap()).unwrap().features;
    let mut asked: BTreeSet<&str> = room.features().into_iter().collect();
    // A picture of the sky, asked directly or not.
    for sky_light in [false, true] {
        asked.extend(Needs { sky: true, sky_light, sun: true, ..Needs::default() }.features());
    }
    let every = MaterialMaps { diffuse: 1, emission: 1, opacity: 1, relief: 1, ..MaterialMaps::default() };
    asked.extend(Needs { maps: &[every], ..Needs::default() }.features());
    asked.extend(Needs { triangles: 32, lens: true, point_lights: true, ..Needs::default() }.features());
    // Of the device, not of the scene.
    asked.insert("software");
    // Of the pass that replays a path.
    asked.insert("record");
    assert_eq!(Vec::from_iter(asked), Vec::from_iter(named));
}

/// The samples of a batch: layer by layer, pixel by pixel.
pub fn samples(rig: &mut Runtime, params: &TraceParams) -> Vec<RadianceSample> {
    trace_batch(rig, params);
    let count = params.window_width * params.window_height * params.layers;
    rig.read_some("radiance", count as usize).unwrap()
}

/// Sums over the blocks of a batch, block by block: radiance and rays.
fn block_sums(params: &TraceParams, of: impl Fn(u32, UVec2) -> (DVec3, u32)) -> Vec<(DVec3, u64)> {
    let columns = params.window_width.div_ceil(BLOCK);
    let mut sums = vec![(DVec3::ZERO, 0); (columns * params.window_height.div_ceil(BLOCK)) as usize];
    for layer in 0..params.layers {
        for y in 0..params.window_height {
            for x in 0..params.window_width {
                let (radiance, rays) = of(layer, UVec2::new(x, y));
                let sum = &mut sums[(y / BLOCK * columns + x / BLOCK) as usize];
                *sum = (sum.0 + radiance, sum.1 + u64::from(rays));
            }
        }
    }
    sums
}

fn gpu_sums(rig: &mut Runtime, params: &TraceParams) -> Vec<(DVec3, u64)> {
    let got = samples(rig, params);
    block_sums(params, |layer, p| {
        let sample = got[((layer * params.window_height + p.y) * params.window_width + p.x) as usize];
        assert_eq!(sample.info & SAMPLE_BAD, 0, "a bad sample at {p}, layer {layer}: {sample:?}");
        (sample.rgb.as_dvec3(), sample.info)
    })
}

/// Whether two estimators agree in every block and channel; each gives block sums of batch `i`, the second is right.
fn compare(
    mut ours: impl FnMut(usize) -> Vec<(DVec3, u64)>,
    mut right: impl FnMut(usize) -> Vec<(DVec3, u64)>,
) -> Result<(), String> {
    let batches: Vec<_> = (0..BATCHES).map(|i| (ours(i), right(i))).collect();
    for block in 0..batches[0].0.len() {
        for c in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| batches[i].0[block].0[c] - batches[i].1[block].0[c]),
                mean: batches.iter().map(|(_, right)| right[block].0[c]).sum::<f64>() / BATCHES as f64,
            };
            agree(&pairs).map_err(|why| format!("block {block}, channel {c}: {why}"))?;
        }
    }
    Ok(())
}

/// Batch `i` of equally large ones.
fn batch(params: &TraceParams, i: usize) -> TraceParams {
    TraceParams { first_sample: i as u32 * params.layers, ..*params }
}

/// The kernel's sums of batch `i`.
fn kernel(room: &Room, library: Library, params: &TraceParams) -> impl FnMut(usize) -> Vec<(DVec3, u64)> {
    let (mut rig, params) = (Runtime::new(support::gpu(), library), *params);
    room.load(&mut rig);
    move |i| gpu_sums(&mut rig, &batch(&params, i))
}

/// The twin's sums of batch `i`.
fn twin_sums(room: &Room, params: &TraceParams) -> impl Fn(usize) -> Vec<(DVec3, u64)> {
    let (twin, params) = (room.twin(), *params);
    move |i| {
        let params = batch(&params, i);
        block_sums(&params, |layer, p| {
            let traced = twin.sample(&params, p, params.first_sample + layer);
            (traced.radiance, traced.rays)
        })
    }
}

pub fn against_twin(room: &Room, library: Library, params: &TraceParams) -> Result<(), String> {
    compare(kernel(room, library, params), twin_sums(room, params))
}

/// Whether the twin draws what the kernel does, with and without asking lights.
pub fn both_ways_equal_the_twin(room: &Room) {
    for next_event in [false, true] {
        let room = Room { next_event, roulette: true, ..room.clone() };
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("asked {next_event}: {why}"));
    }
}

/// Holds the twin to each planted mistake: a module, what is right in it, and what is wrong. Each costs a kernel: all are linked, but only the
/// first and every third behind it are traced, save where there is time for all (`LUCERNA_STRESS`).
pub fn sees_mistakes(room: &Room, mistakes: &[(&str, &str, &str)]) {
    let params = small(room);
    let sums = (0..BATCHES).map(twin_sums(room, &params)).collect::<Vec<_>>();
    let features = room.features().into_iter().map(str::to_owned).collect();
    for (i, (module, right, wrong)) in mistakes.iter().enumerate() {
        let library = planted(module, right, wrong);
        if let Err(error) = library.link("passes/trace/path", &features) {
            panic!("{wrong} in {module} is no code: {}", error.report());
        }
        if i % 3 == 0 || support::stress() {
            let seen = compare(kernel(room, library, &params), |i| sums[i].clone());
            assert!(seen.is_err(), "{wrong} in {module} went unnoticed");
        }
    }
}

/// Whether asking lights directly finds the same in 8 x 8 pixels of a room as finding them by chance: 330,000 paths each.
pub fn compare_integrators(room: &Room) -> Result<(), String> {
    let trace = |next_event: bool, seed: u32| {
        let room = Room { next_event, ..room.clone() };
        let params = TraceParams { layers: 160, seed, ..room.params(UVec2::splat(8)) };
        let mut rig = support::rig();
        room.load(&mut rig);
        move |i: usize| gpu_sums(&mut rig, &batch(&params, i))
    };
    compare(trace(true, 2), trace(false, 1))
}

/// 24 x 24 pixels and 4 samples a batch: 128 samples a pixel in all.
pub fn small(room: &Room) -> TraceParams {
    TraceParams { layers: 4, ..room.params(UVec2::splat(24)) }
}

/// A closed box of one material: the inside of every ray.
fn furnace(albedo: f32, emission: f32) -> Room {
    let mut room = Room::default();
    let wall = room.material(matte(Vec3::splat(albedo), Vec3::splat(emission)));
    room.walls([Some(wall); 6]);
    room
}

pub fn inside(room: &Room, size: UVec2, max_depth: u32) -> TraceParams {
    TraceParams { position: Vec3::new(0.2, -0.3, 0.1), max_depth, ..room.params(size) }
}
