//! Plans the batch of samples this run adds, and records it.

use bevy_ecs::prelude::*;

use super::governor::Governor;
use super::state::{Batch, Budget, Device, FilmProgress, Frame, PackedScene, keep_fault, no_fault};
use super::{EngineError, Phase};
use crate::layout::trace::TraceParams;
use crate::passes::{film, trace};

/// Memory for the samples of a batch, before the film adds them.
const BATCH_BYTES: u64 = 128 << 20;

/// A driver may take no more workgroups along z.
const MOST_LAYERS: u64 = 1024;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems((plan_batch, record_batch.pipe(keep_fault)).chain().in_set(Phase::Trace).run_if(no_fault));
}

impl Batch {
    /// The trace kernel's parameters: the window is the batch's rows.
    pub fn params(&self, scene: &PackedScene) -> TraceParams {
        TraceParams {
            window_y: scene.shot.window_y + self.first_row,
            window_height: self.rows,
            first_sample: self.first_sample,
            layers: self.layers,
            ..scene.shot
        }
    }
}

/// As many samples as the governor gives: whole layers, or some rows of one. Nothing, if the film is finished.
fn plan_batch(
    mut batch: ResMut<Batch>,
    progress: Res<FilmProgress>,
    scene: Res<PackedScene>,
    governor: Res<Governor>,
    budget: Res<Budget>,
    device: Res<Device>,
) {
    *batch = Batch::default();
    if progress.samples >= scene.target {
        return;
    }
    let (width, height) = (u64::from(scene.shot.window_width), u64::from(scene.shot.window_height));
    let limit = BATCH_BYTES.min(device.0.gpu().limits.max_storage_buffer_binding_size);
    let fit = (limit / trace::buffers(1, 1)[0].1).max(1);
    let wanted = (governor.samples(budget.0.as_secs_f64()) as u64).clamp(1, fit);
    let (first_sample, first_row) = (progress.samples, progress.rows);
    let layers = (wanted / (width * height)).min(u64::from(scene.target - progress.samples)).min(MOST_LAYERS);
    *batch = if first_row == 0 && layers >= 1 {
        Batch { first_sample, layers: layers as u32, first_row, rows: height as u32 }
    } else {
        let rows = (wanted / width).clamp(1, height - u64::from(first_row));
        Batch { first_sample, layers: 1, first_row, rows: rows as u32 }
    };
}

/// Records the film's reset if it is due, and the trace kernel over the batch.
fn record_batch(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    mut progress: ResMut<FilmProgress>,
    batch: Res<Batch>,
    scene: Res<PackedScene>,
) -> Result<(), EngineError> {
    if batch.layers == 0 {
        return Ok(());
    }
    let width = scene.shot.window_width;
    if !progress.cleared {
        film::record_reset(&mut frame.trace, width * scene.shot.window_height);
        progress.cleared = true;
    }
    for (name, bytes) in trace::buffers(u64::from(width) * u64::from(batch.rows), batch.layers) {
        device.0.reserve(name, bytes)?;
    }
    trace::record(&mut frame.trace, &batch.params(&scene));
    Ok(())
}
