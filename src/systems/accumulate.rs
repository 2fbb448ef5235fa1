//! Records the adding of a batch to the film.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{Batch, FilmProgress, Frame, PackedScene, no_fault};
use crate::passes::film;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(accumulate_batch.in_set(Phase::Accumulate).run_if(no_fault));
}

fn accumulate_batch(
    mut frame: ResMut<Frame>,
    mut progress: ResMut<FilmProgress>,
    batch: Res<Batch>,
    scene: Res<PackedScene>,
) {
    if batch.layers == 0 {
        return;
    }
    let first_pixel = batch.first_row * scene.shot.window_width;
    film::record_accumulate(&mut frame.trace, &batch.params(&scene), scene.exponent, first_pixel);
    progress.outdate_beauty();
    progress.rows += batch.rows;
    if progress.rows == scene.shot.window_height {
        progress.rows = 0;
        progress.samples += batch.layers;
    }
}
