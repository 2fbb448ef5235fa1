//! Plans the batch of samples this run adds, and records it.

mod planner;

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, Budget, Device, FilmProgress, Frame, Governor, Live, Robust, Shot, Target};
use super::run::counted;
use crate::components::Film;
use crate::layout::trace::TraceParams;
use crate::passes::lattice::Lattice;
use crate::passes::{blocks, film, trace};
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
            plan_batch.pipe(counted("plan_batch")).run_if(samples_wanted),
            record_batch.pipe(counted("record_batch")).run_if(batch_planned),
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
    let limit = most_bytes(&device);
    let fit = (limit / trace::buffers(1, 1)[0].1).max(1);
    let samples = (governor.samples(budget.0.as_secs_f64()) as u64).clamp(1, fit);
    let left = u64::from(target.0 - progress.samples).min(MOST_LAYERS);
    let planner = Planner { size: shot.size(), live: live.0, reuse: shot.reuses().then(|| Reused::of(&shot, limit)) };
    *batch = planner.next_batch(&progress, samples, left);
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
        if robust.0 {
            blocks::record_reset(&mut frame.trace, size.x * size.y);
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
