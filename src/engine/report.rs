//! Accounts of the work.

use std::collections::{BTreeMap, BTreeSet};

use bevy_ecs::prelude::*;

use super::{Engine, film, spared};
use crate::gpu::{DeviceMemory, GpuTable, PassCompile, PassTiming};
use crate::layout::film::{BAD_LOG, BadSample, FilmCounters};
use crate::layout::sort::SortPlan;
use crate::layout::tree::{Triangle, node_count};
use crate::passes::sort::SORT_PLAN;
use crate::systems::resources::{Device, Shot, Spared, Spent, Textures, TileCounts, Tiles};
use crate::systems::{EngineError, Entered};

/// What the engine did since it opened.
#[derive(Clone, Debug)]
pub struct Report {
    /// Adapter and driver.
    pub adapter: String,
    pub triangles: u32,
    pub nodes: u32,
    /// Textures, and the bytes that they take.
    pub textures: u32,
    pub texture_bytes: u64,
    /// Samples of the film, over all pixels.
    pub samples: u64,
    /// By how much tiles differ in samples; none where all pixels have the same number.
    pub tiles: Option<TileCounts>,
    /// Rays of those samples, counted on the GPU.
    pub rays: u64,
    /// Seconds of taking up the scene: entities to arrays, and sending those.
    pub seconds_extract: f64,
    /// Seconds of linking, validating and compiling what was missing of the passes.
    pub seconds_compile: f64,
    /// What that took by pass, in the order of names: those of one scene are compiled at the same time.
    pub compiles: Vec<PassCompile>,
    /// Seconds from the first submission of a tree to its end.
    pub seconds_build: f64,
    /// Seconds of all batches of samples, from submission to end.
    pub seconds_trace: f64,
    /// Samples of the film that were not added.
    pub bad_samples: u64,
    /// The first of them, up to [`BAD_LOG`]; by sample and pixel.
    pub bad_log: Vec<BadSample>,
    /// Halves of the film's pixels that are full: their sums hold no more samples.
    pub full_halves: u64,
    /// GPU time by pass since the last report, if timing is on.
    pub passes: Vec<PassTiming>,
    /// Dispatches by pass.
    pub dispatches: BTreeMap<&'static str, u64>,
    /// Features that the scene needs, of [`FEATURES`](crate::passes::features::FEATURES).
    pub features: BTreeSet<String>,
    /// Digits of the keys of the tree's sort that were sorted, where passes did that: the others agree in all keys, and were skipped.
    pub sorted_digits: Option<u32>,
    /// What was there already when the film began.
    pub spared: Spared,
    /// What is held on the device, and the most that was since the engine opened.
    pub memory: DeviceMemory,
}

impl Report {
    /// The same of two films that were traced one after the other, by one engine: what a film counts by itself is added up.
    pub fn after(self, earlier: Self) -> Self {
        let mut bad_log = [earlier.bad_log, self.bad_log].concat();
        bad_log.truncate(BAD_LOG as usize);
        Self {
            samples: earlier.samples + self.samples,
            rays: earlier.rays + self.rays,
            bad_samples: earlier.bad_samples + self.bad_samples,
            bad_log,
            full_halves: earlier.full_halves + self.full_halves,
            passes: added(earlier.passes, self.passes),
            ..self
        }
    }
}

/// Times by pass, each name once, in the order in which they came.
fn added(mut passes: Vec<PassTiming>, more: Vec<PassTiming>) -> Vec<PassTiming> {
    for pass in more {
        match passes.iter_mut().find(|held| held.name == pass.name) {
            None => passes.push(pass),
            Some(held) => {
                held.count += pass.count;
                held.milliseconds += pass.milliseconds;
            }
        }
    }
    passes
}

/// Adds up what was done.
fn read_report(world: &mut World) -> Result<Report, EngineError> {
    let progress = film::progress(world);
    let spent = *world.resource::<Spent>();
    let triangles = world.resource::<GpuTable<Triangle>>().len() as u32;
    let uses = &world.resource::<Textures>().uses;
    let textures = (uses.len() as u32, uses.iter().map(|used| used.bytes).sum());
    let shot = world.resource::<Shot>();
    let (window, features) = (shot.size(), shot.features.clone());
    let tiles = world.resource::<Tiles>().counts();
    let device = &mut world.resource_mut::<Device>().0;
    let counters = match progress.begun {
        true => device.read_some::<FilmCounters>("counters", 1)?[0],
        false => FilmCounters::default(),
    };
    let bad = counters.bad.0;
    let passes = device.timings()?;
    // With the times that were just read.
    let spared = spared::spared(world);
    let device = &mut world.resource_mut::<Device>().0;
    Ok(Report {
        adapter: device.gpu().name(),
        triangles,
        nodes: node_count(triangles),
        textures: textures.0,
        texture_bytes: textures.1,
        samples: progress.traced(window),
        tiles: tiles.filter(|_| progress.by_tiles > 0),
        rays: u64::from(counters.rays_hi.0) << 32 | u64::from(counters.rays_lo.0),
        seconds_extract: (spent.steps - spent.compile - spent.build - spent.trace - spent.picture).max(0.0),
        seconds_compile: spent.compile,
        compiles: device.compiler().compile_times(),
        seconds_build: spent.build,
        seconds_trace: spent.trace,
        bad_samples: u64::from(bad),
        bad_log: sorted(&counters.log[..bad.min(BAD_LOG) as usize]),
        full_halves: u64::from(counters.full.0),
        passes,
        sorted_digits: match device.dispatches().contains_key(SORT_PLAN.name) {
            true => Some(device.read_some::<SortPlan>("sort_plan", 1)?[0].digits_run),
            false => None,
        },
        dispatches: device.dispatches().clone(),
        features,
        spared,
        memory: device.memory(),
    })
}

impl Engine {
    /// How often each pass was dispatched since the engine opened.
    pub fn dispatches(&self) -> &BTreeMap<&'static str, u64> {
        self.world.resource::<Device>().0.dispatches()
    }

    /// Bytes sent to each buffer since the engine opened; `params` are the parameters of dispatches.
    pub fn uploads(&self) -> &BTreeMap<&'static str, u64> {
        self.world.resource::<Device>().0.uploads()
    }

    /// How often each system was entered since the engine opened.
    pub fn entered(&self) -> &BTreeMap<&'static str, u64> {
        &self.world.resource::<Entered>().0
    }

    /// What was done so far, and what it took.
    pub fn report(&mut self) -> Result<Report, EngineError> {
        read_report(&mut self.world)
    }
}

/// Which workgroup logs first is chance.
fn sorted(log: &[BadSample]) -> Vec<BadSample> {
    let mut log = log.to_vec();
    log.sort_by_key(|bad| (bad.sample, bad.pixel));
    log
}
