//! Records the adding of a batch to the film, and to the blocks beside it where a robust mean is wanted; of an adaptive film, with what halves
//! of tiles tell.

use bevy_ecs::prelude::*;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, Device, FilmProgress, Frame, Robust, Shot, Tiles};
use super::run::counted;
use crate::components::Film;
use crate::layout::adaptive::TallyParams;
use crate::layout::film::AccumulateParams;
use crate::passes::{adaptive, blocks, film};

pub fn add_systems(schedule: &mut Schedule) {
    let batch_planned = |batch: Res<Batch>| !batch.is_empty() && batch.tiles.is_none();
    let tiles_planned = |batch: Res<Batch>| batch.tiles.is_some();
    let pilot_ends = |batch: Res<Batch>, shot: Res<Shot>, progress: Single<&FilmProgress, With<Film>>| {
        let is_whole = !progress.is_between() && Tiles::is_tallied(progress.samples);
        !batch.is_empty() && batch.tiles.is_none() && shot.is_adaptive() && is_whole
    };
    schedule.add_systems(
        (
            accumulate_batch.pipe(counted("accumulate_batch")).run_if(batch_planned),
            accumulate_tiles.pipe(counted("accumulate_tiles")).run_if(tiles_planned),
            tally_all.pipe(counted("tally_all")).run_if(pilot_ends),
        )
            .chain()
            .in_set(Phase::Accumulate),
    );
}

fn accumulate_batch(
    mut frame: ResMut<Frame>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    batch: Res<Batch>,
    shot: Res<Shot>,
    robust: Res<Robust>,
) {
    let size = shot.size();
    let mut params = film::accumulate_params(&batch.params(&shot), shot.exponent, &shot.params);
    film::take_from(&mut params, &batch.traced(&shot));
    params.replaces = u32::from(progress.previewed && progress.samples == 0);
    film::record_accumulate(&mut frame.trace, &params);
    if robust.0 && !shot.is_adaptive() {
        blocks::record(&mut frame.trace, &params);
    }
    let before = progress.shows();
    progress.add(&batch, size);
    // Until there is a finer level, the picture stays what it is.
    if progress.samples > 0 || progress.previewed || progress.shows() != before {
        progress.outdate_beauty();
    }
}

/// The same of a batch of tiles.
fn accumulate_tiles(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    batch: Res<Batch>,
    shot: Res<Shot>,
    tiles: Res<Tiles>,
) -> Result<(), EngineError> {
    let runs = batch.tiles.map_or(0, |tiles| tiles.runs);
    let params = film::accumulate_params(&shot.params, shot.exponent, &shot.params);
    adaptive::record_accumulate(&mut frame.trace, &AccumulateParams { runs, ..params });
    progress.add(&batch, shot.size());
    if runs > 0 {
        progress.outdate_beauty();
    }
    record_tally(&mut device, &mut frame, &shot, &tiles)
}

/// Halves of all tiles, after the first samples, of which all have as many.
fn tally_all(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    progress: Single<&FilmProgress, With<Film>>,
    shot: Res<Shot>,
    mut tiles: ResMut<Tiles>,
) -> Result<(), EngineError> {
    tiles.trace_all(progress.samples);
    record_tally(&mut device, &mut frame, &shot, &tiles)
}

/// Records the tallies that are due.
fn record_tally(device: &mut Device, frame: &mut Frame, shot: &Shot, tiles: &Tiles) -> Result<(), EngineError> {
    let runs = tiles.tally_runs.len() as u32;
    if runs == 0 {
        return Ok(());
    }
    for (name, bytes) in adaptive::tally_buffers(runs.into()) {
        device.0.reserve(name, bytes)?;
    }
    device.0.upload("tally_runs", &tiles.tally_runs)?;
    let window = &shot.params;
    let params = TallyParams {
        window_x: window.window_x,
        window_y: window.window_y,
        window_width: window.window_width,
        window_height: window.window_height,
        runs,
        scale: 2f32.powi(-shot.exponent),
    };
    adaptive::record_tally(&mut frame.trace, &params);
    Ok(())
}
