//! Records the picture of the film, once it is finished.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{FilmProgress, Frame, PackedScene, no_fault};
use crate::passes::film;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(present_finished_film.in_set(Phase::Present).run_if(no_fault));
}

fn present_finished_film(mut frame: ResMut<Frame>, mut progress: ResMut<FilmProgress>, scene: Res<PackedScene>) {
    let finished = progress.samples >= scene.target;
    if progress.cleared && !progress.shown && finished {
        let pixels = scene.shot.window_width * scene.shot.window_height;
        film::record_display(&mut frame.trace, pixels, scene.exponent, scene.exposure);
        progress.shown = true;
    }
}
