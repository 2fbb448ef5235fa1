//! Records the picture of the film, where it is looked at.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{FilmProgress, Frame, PackedScene, no_fault};
use crate::passes::film;

/// Whether somebody looks at the picture while it comes: a window does; without one only the last picture counts.
#[derive(Resource, Default)]
pub struct Watched(pub bool);

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(present_changed_film.in_set(Phase::Present).run_if(no_fault));
}

fn present_changed_film(
    mut frame: ResMut<Frame>,
    mut progress: ResMut<FilmProgress>,
    scene: Res<PackedScene>,
    watched: Res<Watched>,
) {
    let finished = progress.samples >= scene.target;
    if progress.cleared && !progress.shown && (finished || watched.0) {
        let pixels = scene.shot.window_width * scene.shot.window_height;
        film::record_display(&mut frame.trace, pixels, scene.exponent, scene.exposure);
        progress.shown = true;
    }
}
