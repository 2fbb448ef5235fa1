//! Records the picture: of the film, once it is finished, or after every batch for those who watch; or a view of what is seen
//! first, once. The film goes on beneath a view.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::Phase;
use super::state::{FilmProgress, Frame, Live, PackedScene, Viewed, no_fault};
use crate::gpu::Shown;
use crate::layout::view::{ViewMode, ViewParams};
use crate::passes::{film, view};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(present_picture.in_set(Phase::Present).run_if(no_fault));
}

fn present_picture(
    mut frame: ResMut<Frame>,
    mut progress: ResMut<FilmProgress>,
    scene: Res<PackedScene>,
    live: Res<Live>,
    viewed: Res<Viewed>,
) {
    if progress.shown == Some(viewed.0) {
        return;
    }
    if viewed.0 != ViewMode::Beauty {
        view::record(&mut frame.picture, &view_params(&scene, viewed.0));
    } else if progress.cleared && (live.0 || progress.samples >= scene.target) {
        let pixels = scene.shot.window_width * rows_traced(&progress, &scene);
        film::record_display(&mut frame.picture, pixels, scene.exponent, scene.exposure);
    } else {
        return;
    }
    progress.shown = Some(viewed.0);
}

/// What the pass `view` is told.
pub fn view_params(scene: &PackedScene, mode: ViewMode) -> ViewParams {
    let size = (scene.high - scene.low).length() as f32;
    let reach = if size.is_normal() { size } else { 1.0 };
    ViewParams { shot: scene.shot, mode: mode as u32, reach, pad0: 0, pad1: 0 }
}

/// What of the picture there is: all of a view; of the film, the rows that have a sample.
pub fn shown(progress: &FilmProgress, scene: &PackedScene) -> Shown {
    let size = UVec2::new(scene.shot.window_width, scene.shot.window_height);
    let is_view = progress.shown.is_some_and(|mode| mode != ViewMode::Beauty);
    Shown { size, rows: if is_view { size.y } else { rows_traced(progress, scene) } }
}

/// All rows once every pixel has a sample, before that those that have one.
fn rows_traced(progress: &FilmProgress, scene: &PackedScene) -> u32 {
    match (progress.cleared, progress.samples) {
        (false, _) => 0,
        (true, 0) => progress.rows,
        (true, _) => scene.shot.window_height,
    }
}
