//! Records the picture of the film: once it is finished, or after every batch for those who watch.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::Phase;
use super::state::{FilmProgress, Frame, Live, PackedScene, no_fault};
use crate::gpu::Shown;
use crate::passes::film;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(present_film.in_set(Phase::Present).run_if(no_fault));
}

fn present_film(
    mut frame: ResMut<Frame>,
    mut progress: ResMut<FilmProgress>,
    scene: Res<PackedScene>,
    live: Res<Live>,
) {
    let due = live.0 || progress.samples >= scene.target;
    if progress.cleared && !progress.shown && due {
        let shown = shown(&progress, &scene);
        film::record_display(&mut frame.picture, shown.size.x * shown.rows, scene.exponent, scene.exposure);
        progress.shown = true;
    }
}

/// What of the picture there is: all of it once every pixel has a sample, before that the rows that have one.
pub fn shown(progress: &FilmProgress, scene: &PackedScene) -> Shown {
    let size = UVec2::new(scene.shot.window_width, scene.shot.window_height);
    let rows = match (progress.cleared, progress.samples) {
        (false, _) => 0,
        (true, 0) => progress.rows,
        (true, _) => size.y,
    };
    Shown { size, rows }
}
