//! Records the adding of a batch to the film, and to the blocks beside it where a robust mean is wanted.

use bevy_ecs::prelude::*;

use super::phase::Phase;
use super::resources::{Batch, FilmProgress, Frame, Robust, Shot};
use super::run::counted;
use crate::components::Film;
use crate::passes::{blocks, film};

pub fn add_systems(schedule: &mut Schedule) {
    let batch_planned = |batch: Res<Batch>| !batch.is_empty();
    let system = accumulate_batch.pipe(counted("accumulate_batch"));
    schedule.add_systems(system.run_if(batch_planned).in_set(Phase::Accumulate));
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
    if robust.0 {
        blocks::record(&mut frame.trace, &params);
    }
    let before = progress.shows();
    progress.add(&batch, size);
    // Until there is a finer level, the picture stays what it is.
    if progress.samples > 0 || progress.previewed || progress.shows() != before {
        progress.outdate_beauty();
    }
}
