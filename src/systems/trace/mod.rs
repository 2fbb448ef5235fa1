//! Plans the batch of samples this run adds, and records it.

mod planner;

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{
    Batch, Budget, Device, FilmProgress, Frame, Governor, Live, PILOT_SPP, Robust, Shot, Target, Tiles,
};
use super::run::counted;
use crate::components::Film;
use crate::layout::adaptive::TILE_LANES;
use crate::layout::trace::TraceParams;
use crate::passes::lattice::Lattice;
use crate::passes::{adaptive, blocks, film, trace};
use planner::{Planner, Reused};

/// Memory for the samples of a batch, before the film adds them.
const BATCH_BYTES: u64 = 128 << 20;

/// A driver may take no more workgroups along z.
const MOST_LAYERS: u64 = 1024;

pub fn add_systems(schedule: &mut Schedule) {
    let batch_planned = |batch: Res<Batch>| !batch.is_empty();
    schedule.add_systems(
        (
            forget_batch.run_if(batch_planned),
            hear_tallies.pipe(counted("hear_tallies")).run_if(tallies_asked).run_if(samples_wanted),
            plan_batch.pipe(counted("plan_batch")).run_if(samples_wanted),
            record_batch.pipe(counted("record_batch")).run_if(batch_planned).run_if(not(tiles_planned)),
            record_tiles.pipe(counted("record_tiles")).run_if(tiles_planned),
        )
            .chain()
            .in_set(Phase::Trace),
    );
}

impl Batch {
    /// The film's part of the trace kernel's parameters: the window is the batch's columns and rows.
    pub fn params(&self, shot: &Shot) -> TraceParams {
        let Lattice { first, shift } = self.sweep.pixels;
        TraceParams {
            window_x: shot.params.window_x + first.x,
            window_y: shot.params.window_y + first.y + (self.first_row << shift.y),
            window_width: self.sweep.pixels.size(shot.size()).x,
            window_height: self.rows,
            column_shift: shift.x,
            row_shift: shift.y,
            first_sample: self.first_sample,
            layers: self.layers,
            keeps: u32::from(self.sweep.preview),
            ..shot.params
        }
    }

    /// Parameters of what is traced for it.
    pub fn traced(&self, shot: &Shot) -> TraceParams {
        let params = self.params(shot);
        if shot.reuses() && !self.sweep.preview { trace::whole_blocks(&params) } else { params }
    }
}

/// The last run's batch is over.
fn forget_batch(mut batch: ResMut<Batch>) {
    *batch = Batch::default();
}

/// Run condition: the film is not finished, and goes on.
fn samples_wanted(progress: Single<&FilmProgress, With<Film>>, target: Res<Target>) -> bool {
    progress.samples < target.0 && !progress.rests
}

/// Run condition: the last batch has told something of tiles.
fn tallies_asked(tiles: Res<Tiles>) -> bool {
    tiles.tallies() > 0
}

/// Run condition: the batch is of tiles.
fn tiles_planned(batch: Res<Batch>) -> bool {
    batch.tiles.is_some()
}

/// Reads back what halves of tiles have told.
fn hear_tallies(device: Res<Device>, mut tiles: ResMut<Tiles>) -> Result<(), EngineError> {
    let tallies = device.0.read_some("tallies", tiles.tallies())?;
    tiles.hear(&tallies);
    Ok(())
}

/// What a batch is planned from.
#[derive(SystemParam)]
struct Wanted<'w, 's> {
    progress: Single<'w, 's, &'static mut FilmProgress, With<Film>>,
    tiles: ResMut<'w, Tiles>,
    shot: Res<'w, Shot>,
    target: Res<'w, Target>,
    governor: Res<'w, Governor>,
    budget: Res<'w, Budget>,
    live: Res<'w, Live>,
    device: Res<'w, Device>,
}

/// As many samples as the governor gives: whole layers, or some rows of a sweep over one.
fn plan_batch(mut batch: ResMut<Batch>, wanted: Wanted) {
    let Wanted { mut progress, mut tiles, shot, target, governor, budget, live, device } = wanted;
    let limit = most_bytes(&device);
    let fit = (limit / trace::buffers(1, 1)[0].1).max(1);
    let samples = (governor.samples(budget.0.as_secs_f64()) as u64).clamp(1, fit);
    let mut left = u64::from(target.0 - progress.samples).min(MOST_LAYERS);
    if shot.is_adaptive() {
        if progress.samples >= PILOT_SPP {
            // What tiles lend is to fit, too.
            let fit = if shot.reuses() { Reused::of(&shot, limit).fit } else { u64::MAX };
            *batch = next_tiles(&mut progress, &mut tiles, samples.min(fit), &shot, target.0);
            return;
        }
        // Batches end where halves are to be tallied.
        let end = if progress.samples < PILOT_SPP / 2 { PILOT_SPP / 2 } else { PILOT_SPP };
        left = left.min(u64::from(end - progress.samples));
    }
    let planner = Planner { size: shot.size(), live: live.0, reuse: shot.reuses().then(|| Reused::of(&shot, limit)) };
    *batch = planner.next_batch(&progress, samples, left);
}

/// About as many samples of the tiles that lack some; if none does, from a greater average on.
fn next_tiles(progress: &mut FilmProgress, tiles: &mut Tiles, samples: u64, shot: &Shot, target: u32) -> Batch {
    if progress.goal <= progress.samples {
        let size = shot.size();
        let more = samples / (u64::from(size.x) * u64::from(size.y)).max(1);
        progress.goal = tiles.aim(progress.samples, u32::try_from(more).unwrap_or(u32::MAX), target);
    }
    let listed = tiles.list(samples);
    progress.by_tiles = tiles.all_samples();
    Batch { first_sample: progress.samples, layers: 1, tiles: Some(listed), ..Batch::default() }
}

/// Bytes that a buffer of samples may have.
fn most_bytes(device: &Device) -> u64 {
    BATCH_BYTES.min(device.0.gpu().limits.max_storage_buffer_binding_size)
}

/// Records the reset of a film without samples, and the trace kernel over the batch.
fn record_batch(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    progress: Single<&FilmProgress, With<Film>>,
    batch: Res<Batch>,
    shot: Res<Shot>,
    robust: Res<Robust>,
) -> Result<(), EngineError> {
    let size = shot.size();
    if progress.is_empty() {
        film::record_reset(&mut frame.trace, size.x * size.y);
        if robust.0 && !shot.is_adaptive() {
            blocks::record_reset(&mut frame.trace, size.x * size.y);
        }
        if shot.is_adaptive() {
            adaptive::record_reset(&mut frame.trace, size.x * size.y);
        }
    } else if batch.begins_after_preview(&progress) {
        film::record_recount(&mut frame.trace);
    }
    let params = batch.traced(&shot);
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    for (name, bytes) in trace::buffers(pixels, batch.layers) {
        device.0.reserve(name, bytes)?;
    }
    if !shot.reuses() {
        trace::record(&mut frame.trace, &params);
        return Ok(());
    }
    let textured = shot.is_textured();
    let fit = (Reused::of(&shot, most_bytes(&device)).fit / pixels.max(1)).clamp(1, u64::from(batch.layers)) as u32;
    for (name, bytes) in trace::reuse_buffers(pixels, fit, textured) {
        device.0.reserve(name, bytes)?;
    }
    if batch.sweep.preview {
        trace::record(&mut frame.trace, &params);
    } else {
        trace::record_reused(&mut frame.trace, &params, fit, textured);
    }
    Ok(())
}

/// Records the trace kernel over a batch of tiles.
fn record_tiles(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    tiles: Res<Tiles>,
    shot: Res<Shot>,
) -> Result<(), EngineError> {
    let tile_samples = tiles.samples.len() as u32;
    if tile_samples == 0 {
        return Ok(());
    }
    device.0.upload("tile_samples", &tiles.samples)?;
    device.0.upload("tile_runs", &tiles.runs)?;
    let (reuses, textured) = (shot.reuses(), shot.is_textured());
    let places = u64::from(tile_samples) * u64::from(TILE_LANES);
    let lent = if reuses { trace::reuse_buffers(places, 1, textured) } else { Vec::new() };
    for (name, bytes) in trace::buffers(places, 1).into_iter().chain(lent) {
        device.0.reserve(name, bytes)?;
    }
    let params = TraceParams { tile_samples, ..shot.params };
    adaptive::record_tiles(&mut frame.trace, &params, reuses, textured);
    Ok(())
}
