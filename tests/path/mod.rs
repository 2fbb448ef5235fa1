//! The path kernel against its f64 twin, and in rooms whose answer is known.

mod batches;
mod faults;
mod known;
mod means;
mod reuse;
mod twin;

use std::collections::BTreeSet;

use glam::{UVec2, Vec3};
use lucerna::components::{Energy, Material, Passage};
use lucerna::cpu::rng::Source;
use lucerna::gpu::{HALVES, Runtime};
use lucerna::layout::texture::MaterialMaps;
use lucerna::layout::trace::{RadianceSample, TraceParams};
use lucerna::passes::trace::Needs;
use lucerna::prepare::material;
use lucerna::shader::Library;
use lucerna::stress::scenes::boxes::furnace;
pub use lucerna::stress::scenes::boxes::inside;
use lucerna::stress::tools::paths::{self, Sums, batch, block_sums, twin_sums};

use crate::rooms::{Room, shiny};
use crate::statistics::BATCHES;
use crate::support;
use crate::support::plant::planted;

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
    asked.extend([HALVES, "software"]);
    // Of the film, not of the scene.
    asked.insert("adaptive");
    // Of the passes that replay a path, that show a probe, and that say where the error comes from.
    asked.extend(["record", "probe_view", "sources"]);
    assert_eq!(Vec::from_iter(asked), Vec::from_iter(named));
}

/// The samples of a batch: layer by layer, pixel by pixel.
pub fn samples(rig: &mut Runtime, params: &TraceParams) -> Vec<RadianceSample> {
    paths::samples(rig, params).unwrap()
}

fn gpu_sums(rig: &mut Runtime, params: &TraceParams) -> Sums {
    paths::gpu_sums(rig, params).unwrap()
}

/// Whether two estimators agree in every block and channel; each gives block sums of batch `i`, the second is right.
fn compare(mut ours: impl FnMut(usize) -> Sums, mut right: impl FnMut(usize) -> Sums) -> Result<(), String> {
    paths::compare(|i| Ok(ours(i)), |i| Ok(right(i))).unwrap().check()
}

/// The kernel's sums of batch `i`.
fn kernel(room: &Room, library: Library, params: &TraceParams) -> impl FnMut(usize) -> Sums {
    let mut sums = paths::kernel(&support::gpu(), library, room, params).unwrap();
    move |i| sums(i).unwrap()
}

pub fn against_twin(room: &Room, library: Library, params: &TraceParams) -> Result<(), String> {
    paths::against_twin(&support::gpu(), library, room, params).unwrap().check()
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
        room.load(&mut rig).unwrap();
        move |i: usize| gpu_sums(&mut rig, &batch(&params, i))
    };
    compare(trace(true, 2), trace(false, 1))
}

/// 24 x 24 pixels and 4 samples a batch: 128 samples a pixel in all.
pub fn small(room: &Room) -> TraceParams {
    TraceParams { layers: 4, ..room.params(UVec2::splat(24)) }
}
