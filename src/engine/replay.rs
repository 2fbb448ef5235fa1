//! One sample of one pixel again, with all that happens on its way: by the kernel, and by its twin.
//!
//! Plain functions, no system: they ask the device, and change nothing in the world. What the kernels leave in buffers of samples is read by
//! nobody else: a batch writes before it reads.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3, UVec2, Vec4};

use crate::components::{Integrator, Name, Render, Sampler, UsesMaterial};
use crate::cpu::path::PathScene;
use crate::cpu::replay::{Sample, Verdict, judge};
use crate::cpu::rng::Source;
use crate::cpu::turn::{Turn, turns_of};
use crate::gpu::{GpuTable, TableRow};
use crate::layout::cdf::CdfEntry;
use crate::layout::light::{LightRecord, LightTable};
use crate::layout::probe::{MOST_PROBED, PROBE_BOOL, PROBE_F32, PROBE_U32, PROBE_VEC2, PROBE_VEC3, Probed};
use crate::layout::replay::{MOST_TURNS, PathTurn, Replayed};
use crate::layout::sky::SkyTable;
use crate::layout::trace::{MaterialRecord, RadianceSample, Shading, TraceParams};
use crate::layout::tree::Triangle;
use crate::passes::{Recording, replay, trace};
use crate::shader::Probe;
use crate::systems::EngineError;
use crate::systems::resources::{
    Device, LightDensity, MaterialSlot, MeshSlot, SceneGeometry, Shot, Sky, SkyCell, Tree, texture_set,
};

/// A sample, replayed.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Of the whole film.
    pub pixel: UVec2,
    /// Of the film.
    pub sample: u32,
    /// The rays that the kernel kept, in order.
    pub gpu: Vec<Turn>,
    /// How many it traced.
    pub rays: u32,
    /// What the kernel that keeps rays came to.
    pub replayed: RadianceSample,
    /// What the film's kernel comes to: without what is gathered, where paths are reused.
    pub traced: RadianceSample,
    /// What the film gets: with all that its tile lends.
    pub film: RadianceSample,
    /// Paths are reused within tiles.
    pub reuses: bool,
    /// What the twin says.
    pub verdict: Verdict,
    /// Of all triangles that the rays of both met, in the order of their indices.
    pub places: Vec<TrianglePlace>,
    /// World space point that rays are relative to.
    pub origin: DVec3,
    /// Numbers that code showed on the way, in the order of the calls, as far as they were kept.
    pub probed: Vec<ProbedNumber>,
    /// How many it showed.
    pub all_probed: u32,
}

/// A number that code showed.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedNumber {
    pub name: String,
    pub value: ProbedValue,
    /// Of the path: segments before the one at whose end it was.
    pub bounce: u32,
    /// The ray that was being traced; the number of all where it was behind the last.
    pub turn: usize,
}

/// What code can show.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbedValue {
    /// One to three channels.
    Numbers(Vec<f32>),
    Whole(u32),
    Switch(bool),
}

/// What a triangle is part of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrianglePlace {
    /// In scene order.
    pub triangle: u32,
    /// Name of its mesh.
    pub mesh: String,
    /// Which of that mesh's triangles it is.
    pub of_mesh: u32,
    /// Name of its material; none if it has the default one.
    pub material: Option<String>,
}

impl Replay {
    /// What a triangle is part of.
    pub fn place(&self, triangle: u32) -> Option<&TrianglePlace> {
        self.places.iter().find(|place| place.triangle == triangle)
    }

    /// Whether the kernel that keeps rays came to the same as the film's, to the bit.
    pub fn is_exact(&self) -> bool {
        bytemuck::bytes_of(&self.replayed) == bytemuck::bytes_of(&self.traced)
    }
}

/// What a device says of a sample.
struct Traced {
    kept: Vec<PathTurn>,
    rays: u32,
    replayed: RadianceSample,
    traced: RadianceSample,
    film: RadianceSample,
    probed: Vec<ProbedNumber>,
    all_probed: u32,
}

/// Replays samples of pixels of the whole film; none of those where there is no such pixel, or no tree yet.
pub fn replay_samples(world: &mut World, samples: &[(UVec2, u32)]) -> Result<Vec<Replay>, EngineError> {
    let shot = world.resource::<Shot>();
    let film = UVec2::new(shot.params.film_width, shot.params.film_height);
    if !world.resource::<Tree>().built {
        return Ok(Vec::new());
    }
    let there = samples.iter().filter(|(pixel, _)| pixel.cmplt(film).all());
    let traced = there.map(|(pixel, sample)| Ok((*pixel, *sample, trace_sample(world, *pixel, *sample)?)));
    let traced = traced.collect::<Result<Vec<_>, EngineError>>()?;
    let world: &World = world;
    let (shot, origin) = (world.resource::<Shot>(), world.resource::<SceneGeometry>().origin);
    with_twin(world, &shot.params, |scene| {
        let judged = |(pixel, sample, traced): (UVec2, u32, Traced)| {
            let Traced { kept, rays, replayed, traced, film, probed, all_probed } = traced;
            let (gpu, reuses) = (turns_of(&kept), shot.reuses());
            let of = Sample { pixel, sample, lends: reuses };
            let verdict = judge(scene, &one_sample(&shot.params, pixel, sample), of, &gpu);
            let places = places(world, gpu.iter().chain(&verdict.twin));
            Replay {
                pixel,
                sample,
                gpu,
                rays,
                replayed,
                traced,
                film,
                reuses,
                verdict,
                places,
                origin,
                probed,
                all_probed,
            }
        };
        Ok(traced.into_iter().map(judged).collect())
    })
}

/// Traces a sample by the kernel that keeps its rays, and by those of the film.
fn trace_sample(world: &mut World, pixel: UVec2, sample: u32) -> Result<Traced, EngineError> {
    let shot = world.resource::<Shot>();
    let (params, reuses, textured) = (shot.params, shot.reuses(), shot.is_textured());
    let params = one_sample(&params, pixel, sample);
    let device = &mut world.resource_mut::<Device>().0;
    let tile = if reuses { trace::whole_blocks(&params) } else { params };
    let pixels = u64::from(tile.window_width) * u64::from(tile.window_height);
    let of_tile = if reuses { trace::reuse_buffers(pixels, 1, textured) } else { Vec::new() };
    // What a tile needs last: it is more of the same buffers than the one place that a replay lends to, and the last word counts.
    for (name, bytes) in replay::buffers().into_iter().chain(trace::buffers(pixels, 1)).chain(of_tile) {
        device.reserve(name, bytes)?;
    }
    let mut recording = Recording::default();
    replay::record(&mut recording, &params);
    trace::record(&mut recording, &tile);
    let mut gathering = Recording::default();
    if reuses {
        trace::record_reused(&mut gathering, &tile, 1, textured);
    }
    device.prepare(&[&recording, &gathering])?;
    device.play(&recording)?;
    let at = (params.window_y - tile.window_y) * tile.window_width + params.window_x - tile.window_x;
    let traced: RadianceSample = device.read_one("radiance", at.into())?;
    let film = match reuses {
        true => {
            device.play(&gathering)?;
            device.read_one("radiance", at.into())?
        }
        false => traced,
    };
    device.check_loops()?;
    let Replayed { rgb, info, turns, probed: all_probed, probed_kept, .. } = device.read_one("replayed", 0)?;
    let kept: Vec<PathTurn> = device.read_some("turns", turns.min(MOST_TURNS) as usize)?;
    let shown: Vec<Probed> = device.read_some("probed", probed_kept.min(MOST_PROBED) as usize)?;
    let names = device.probes();
    let probed = shown.iter().filter_map(|shown| probed_number(shown, names.get(shown.name as usize)?)).collect();
    Ok(Traced { kept, rays: turns, replayed: RadianceSample { rgb, info }, traced, film, probed, all_probed })
}

/// What the kernel kept of a number that code showed by a name.
fn probed_number(shown: &Probed, probe: &Probe) -> Option<ProbedNumber> {
    let numbers = |count: usize| shown.bits.to_array()[..count].iter().map(|bits| f32::from_bits(*bits)).collect();
    let value = match shown.kind {
        PROBE_F32 => ProbedValue::Numbers(numbers(1)),
        PROBE_VEC2 => ProbedValue::Numbers(numbers(2)),
        PROBE_VEC3 => ProbedValue::Numbers(numbers(3)),
        PROBE_U32 => ProbedValue::Whole(shown.bits.x),
        PROBE_BOOL => ProbedValue::Switch(shown.bits.x != 0),
        _ => return None,
    };
    Some(ProbedNumber { name: probe.name.clone(), value, bounce: shown.bounce, turn: shown.turn as usize })
}

/// The parameters of a film of one pixel and one sample.
pub(super) fn one_sample(params: &TraceParams, pixel: UVec2, sample: u32) -> TraceParams {
    TraceParams {
        window_x: pixel.x,
        window_y: pixel.y,
        window_width: 1,
        window_height: 1,
        first_sample: sample,
        layers: 1,
        first_layer: 0,
        column_shift: 0,
        row_shift: 0,
        keeps: 0,
        ..*params
    }
}

/// Has `look` look at what the kernel was given, as the twin sees it.
fn with_twin<R>(world: &World, params: &TraceParams, look: impl FnOnce(&PathScene) -> R) -> R {
    let sky = sky_table(world);
    let mut scene = PathScene::new(table::<Triangle>(world), table::<MaterialRecord>(world));
    let render = world.try_query::<&Render>().and_then(|mut films| films.iter(world).next().copied());
    let render = render.unwrap_or_default();
    scene.shading = table::<Shading>(world);
    scene.roulette = render.roulette;
    scene.sampler = match render.sampler {
        Sampler::Pcg => Source::Pcg,
        Sampler::Sobol => Source::Sobol,
    };
    let lights =
        LightTable { lights: table::<LightRecord>(world).to_vec(), density: world.resource::<LightDensity>().0 };
    // Without light sampling the table has points alone.
    scene.lights = (render.integrator == Integrator::Path || !lights.lights.is_empty()).then_some(lights);
    scene.textures = texture_set(world);
    scene.sky = sky.as_ref();
    scene.sky_turn = DMat3::from_cols(params.sky_x.as_dvec3(), params.sky_y.as_dvec3(), params.sky_z.as_dvec3());
    look(&scene)
}

/// The picture of the environment as the kernel has it; none without one.
fn sky_table(world: &World) -> Option<SkyTable> {
    let sky = world.resource::<Sky>();
    sky.source.as_ref()?;
    let cells: Vec<Vec4> = table::<SkyCell>(world).iter().map(|cell| cell.0).collect();
    let cdf = table::<CdfEntry>(world).to_vec();
    Some(SkyTable { size: sky.size, cells, cdf, power: sky.power, brightest: sky.brightest })
}

fn table<T: TableRow>(world: &World) -> &[T] {
    world.resource::<GpuTable<T>>().rows()
}

/// What the triangles that rays met, or that lights are, are part of.
fn places<'a>(world: &World, turns: impl Iterator<Item = &'a Turn>) -> Vec<TrianglePlace> {
    let of = |turn: &Turn| [turn.met.map(|met| met.triangle), turn.light.and_then(|light| light.triangle)];
    let mut triangles: Vec<u32> = turns.flat_map(of).flatten().collect();
    triangles.sort_unstable();
    triangles.dedup();
    let meshes = &world.resource::<SceneGeometry>().meshes;
    let place = |triangle: u32| {
        let slot = |mesh: Entity| world.get::<MeshSlot>(mesh);
        let has = |slot: &MeshSlot| (slot.first..slot.first + slot.count).contains(&triangle);
        let mesh = *meshes.iter().find(|mesh| slot(**mesh).is_some_and(has))?;
        let name = |entity: Entity| world.get::<Name>(entity).map(|name| name.as_str().to_owned());
        let used = world.get::<UsesMaterial>(mesh).filter(|uses| world.get::<MaterialSlot>(uses.0).is_some());
        let of_mesh = triangle - slot(mesh)?.first;
        Some(TrianglePlace { triangle, mesh: name(mesh)?, of_mesh, material: used.and_then(|uses| name(uses.0)) })
    };
    triangles.into_iter().filter_map(place).collect()
}
