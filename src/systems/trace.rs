//! Plans the batch of samples this run adds, and records it.

use bevy_ecs::prelude::*;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, Budget, Device, FilmProgress, Frame, Governor, Shot, Target};
use super::run::counted;
use crate::components::Film;
use crate::layout::trace::TraceParams;
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
    /// The trace kernel's parameters: the window is the batch's rows.
    pub fn params(&self, shot: &Shot) -> TraceParams {
        TraceParams {
            window_y: shot.params.window_y + self.first_row,
            window_height: self.rows,
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

/// Run condition: the film is not finished.
fn samples_wanted(progress: Single<&FilmProgress, With<Film>>, target: Res<Target>) -> bool {
    progress.samples < target.0
}

/// As many samples as the governor gives: whole layers, or some rows of one.
fn plan_batch(
    mut batch: ResMut<Batch>,
    progress: Single<&FilmProgress, With<Film>>,
    shot: Res<Shot>,
    target: Res<Target>,
    governor: Res<Governor>,
    budget: Res<Budget>,
    device: Res<Device>,
) {
    let (width, height) = (u64::from(shot.size().x), u64::from(shot.size().y));
    let limit = BATCH_BYTES.min(device.0.gpu().limits.max_storage_buffer_binding_size);
    let fit = (limit / trace::buffers(1, 1)[0].1).max(1);
    let wanted = (governor.samples(budget.0.as_secs_f64()) as u64).clamp(1, fit);
    let (first_sample, first_row) = (progress.samples, progress.rows);
    let layers = (wanted / (width * height)).min(u64::from(target.0 - progress.samples)).min(MOST_LAYERS);
    *batch = if first_row == 0 && layers >= 1 {
        Batch { first_sample, layers: layers as u32, first_row, rows: height as u32 }
    } else {
        let rows = (wanted / width).clamp(1, height - u64::from(first_row));
        Batch { first_sample, layers: 1, first_row, rows: rows as u32 }
    };
}

/// Records the reset of a film without samples, and the trace kernel over the batch.
fn record_batch(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    progress: Single<&FilmProgress, With<Film>>,
    batch: Res<Batch>,
    shot: Res<Shot>,
) -> Result<(), EngineError> {
    let width = shot.size().x;
    if (progress.samples, progress.rows) == (0, 0) {
        film::record_reset(&mut frame.trace, width * shot.size().y);
    }
    for (name, bytes) in trace::buffers(u64::from(width) * u64::from(batch.rows), batch.layers) {
        device.0.reserve(name, bytes)?;
    }
    trace::record(&mut frame.trace, &batch.params(&shot));
    Ok(())
}
