//! Plans the batch of samples this run adds, and records it.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use glam::UVec2;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, Budget, Device, FilmProgress, Frame, Governor, Live, Shot, Sweep, Target};
use super::run::counted;
use crate::components::Film;
use crate::layout::trace::TraceParams;
use crate::passes::lattice::{Lattice, corners, level_within, refinement};
use crate::passes::{film, trace};

/// Memory for the samples of a batch, before the film adds them.
const BATCH_BYTES: u64 = 128 << 20;

/// A driver may take no more workgroups along z.
const MOST_LAYERS: u64 = 1024;

pub fn add_systems(schedule: &mut Schedule) {
    let batch_planned = |batch: Res<Batch>| !batch.is_empty();
    schedule.add_systems(
        (
            forget_batch.run_if(batch_planned),
            plan_batch.pipe(counted("plan_batch")).run_if(samples_wanted),
            record_batch.pipe(counted("record_batch")).run_if(batch_planned),
        )
            .chain()
            .in_set(Phase::Trace),
    );
}

impl Batch {
    /// The trace kernel's parameters: the window is the batch's columns and rows.
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
            ..shot.params
        }
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

/// What a batch is planned from.
#[derive(SystemParam)]
struct Wanted<'w, 's> {
    progress: Single<'w, 's, &'static FilmProgress, With<Film>>,
    shot: Res<'w, Shot>,
    target: Res<'w, Target>,
    governor: Res<'w, Governor>,
    budget: Res<'w, Budget>,
    live: Res<'w, Live>,
    device: Res<'w, Device>,
}

/// As many samples as the governor gives: whole layers, or some rows of a sweep over one.
fn plan_batch(mut batch: ResMut<Batch>, wanted: Wanted) {
    let Wanted { progress, shot, target, governor, budget, live, device } = wanted;
    let limit = BATCH_BYTES.min(device.0.gpu().limits.max_storage_buffer_binding_size);
    let fit = (limit / trace::buffers(1, 1)[0].1).max(1);
    let samples = (governor.samples(budget.0.as_secs_f64()) as u64).clamp(1, fit);
    let left = u64::from(target.0 - progress.samples).min(MOST_LAYERS);
    *batch = next_batch(&progress, shot.size(), live.0, samples, left);
}

/// The batch that follows on a film of some size: about as many samples as are wanted, in so many layers at most.
fn next_batch(progress: &FilmProgress, size: UVec2, live: bool, samples: u64, most_layers: u64) -> Batch {
    let first_sample = progress.samples;
    let layers = (samples / Lattice::default().pixels(size)).min(most_layers);
    if !progress.is_between() && layers >= 1 {
        return Batch { first_sample, layers: layers as u32, sweep: Sweep::default(), first_row: 0, rows: size.y };
    }
    let sweep = next_sweep(progress, size, live, samples);
    let (first_row, extent) = (progress.rows, sweep.pixels.size(size));
    let rows = match live && progress.is_empty() {
        // Whoever watches sees a film whole from its first batch on.
        true => extent.y,
        false => (samples / u64::from(extent.x)).clamp(1, u64::from(extent.y - first_row)) as u32,
    };
    Batch { first_sample, layers: 1, sweep, first_row, rows }
}

/// The sweep that is under way, or the next: of all pixels, or, where somebody waits for the first sample, of a level.
fn next_sweep(progress: &FilmProgress, size: UVec2, live: bool, samples: u64) -> Sweep {
    match progress.level {
        _ if progress.rows > 0 => progress.sweep,
        Some(level) => Sweep { pixels: refinement(level - 1), level: level - 1 },
        None if live && progress.samples == 0 => {
            let level = level_within(size, samples);
            Sweep { pixels: corners(level), level }
        }
        None => Sweep::default(),
    }
}

/// Records the reset of a film without samples, and the trace kernel over the batch.
fn record_batch(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    progress: Single<&FilmProgress, With<Film>>,
    batch: Res<Batch>,
    shot: Res<Shot>,
) -> Result<(), EngineError> {
    let size = shot.size();
    if progress.is_empty() {
        film::record_reset(&mut frame.trace, size.x * size.y);
    }
    let params = batch.params(&shot);
    let pixels = u64::from(params.window_width) * u64::from(params.window_height);
    for (name, bytes) in trace::buffers(pixels, batch.layers) {
        device.0.reserve(name, bytes)?;
    }
    trace::record(&mut frame.trace, &params);
    Ok(())
}
