//! Plans the batch of samples this run adds, and records it.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use glam::UVec2;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, Budget, Device, FilmProgress, Frame, Governor, Live, Shot, Sweep, Target};
use super::run::counted;
use crate::components::Film;
use crate::layout::trace::{TILE_BLOCK, TraceParams};
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
    let plan = Plan { size: shot.size(), live: live.0, reuse: shot.reuses().then(|| Reused::of(&shot, limit)) };
    *batch = plan.next_batch(&progress, samples, left);
}

/// Bytes that a buffer of samples may have.
fn most_bytes(device: &Device) -> u64 {
    BATCH_BYTES.min(device.0.gpu().limits.max_storage_buffer_binding_size)
}

/// What reuse of paths asks of a batch.
struct Reused {
    /// Pixels of the whole blocks that the window touches.
    pixels: u64,
    /// Pixels whose records fit at once.
    fit: u64,
    /// The row of the window at which its first blocks end.
    first_end: u32,
}

impl Reused {
    fn of(shot: &Shot, limit: u64) -> Self {
        let blocks = trace::whole_blocks(&shot.params);
        let largest = trace::reuse_buffers(1, 1, shot.is_textured()).into_iter().map(|(_, bytes)| bytes).max();
        Self {
            pixels: u64::from(blocks.window_width) * u64::from(blocks.window_height),
            fit: (limit / largest.unwrap_or(1)).max(1),
            first_end: TILE_BLOCK - shot.params.window_y % TILE_BLOCK,
        }
    }

    /// The row, after `first` and not beyond `end` unless there is none, at which blocks end. `first` is such a row, or the window's first.
    fn end_of_rows(&self, first: u32, end: u32) -> u32 {
        let next = if first < self.first_end { self.first_end } else { first + TILE_BLOCK };
        next + end.saturating_sub(next) / TILE_BLOCK * TILE_BLOCK
    }
}

/// What batches are planned for.
struct Plan {
    /// Of the window.
    size: UVec2,
    live: bool,
    reuse: Option<Reused>,
}

impl Plan {
    /// The batch that follows on a film: about as many samples as are wanted, in so many layers at most.
    fn next_batch(&self, progress: &FilmProgress, samples: u64, most_layers: u64) -> Batch {
        let Self { size, live, .. } = *self;
        let first_sample = progress.samples;
        let mut layers = (samples / Lattice::default().pixels(size)).min(most_layers);
        if self.reuse.as_ref().is_some_and(|reuse| reuse.pixels > reuse.fit) {
            layers = 0;
        }
        if !progress.is_between() && layers >= 1 {
            return Batch { first_sample, layers: layers as u32, sweep: Sweep::default(), first_row: 0, rows: size.y };
        }
        let sweep = self.next_sweep(progress, samples);
        let (first_row, extent) = (progress.rows, sweep.pixels.size(size));
        let rows = match live && progress.is_empty() {
            // Whoever watches sees a film whole from its first batch on.
            true => extent.y,
            false => self.next_rows(sweep, first_row, extent, samples),
        };
        Batch { first_sample, layers: 1, sweep, first_row, rows }
    }

    /// How many of a sweep's rows make about so many samples.
    fn next_rows(&self, sweep: Sweep, first_row: u32, extent: UVec2, samples: u64) -> u32 {
        let left = extent.y - first_row;
        let of = |samples: u64| (samples / u64::from(extent.x)).clamp(1, u64::from(left)) as u32;
        match &self.reuse {
            Some(reuse) if !sweep.preview => {
                let rows = of(samples.min(reuse.fit / 2));
                if rows == left { rows } else { (reuse.end_of_rows(first_row, first_row + rows) - first_row).min(left) }
            }
            _ => of(samples),
        }
    }

    /// The sweep that is under way, or the next: of all pixels, or, where somebody waits for the first sample, of a level.
    fn next_sweep(&self, progress: &FilmProgress, samples: u64) -> Sweep {
        let preview = self.reuse.is_some();
        match progress.level {
            _ if progress.rows > 0 => progress.sweep,
            Some(level) => Sweep { pixels: refinement(level - 1), level: level - 1, preview },
            None if self.live && progress.samples == 0 && !progress.previewed => {
                let level = level_within(self.size, samples);
                Sweep { pixels: corners(level), level, preview }
            }
            None => Sweep::default(),
        }
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
