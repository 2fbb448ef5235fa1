//! Records the picture: of the film, once it is finished, or after every batch for those who watch; or a view of what is seen
//! first, once. The film goes on beneath a view.

use bevy_ecs::prelude::*;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{
    Device, Displayed, FilmProgress, Frame, Live, ProbeChosen, SceneGeometry, Shot, Target, Viewed,
};
use super::run::counted;
use crate::components::Film;
use crate::gpu::Runtime;
use crate::layout::probe::NO_PROBE;
use crate::layout::view::{ViewMode, ViewParams};
use crate::passes::{Recording, debug, film, probe, view};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            record_view.pipe(counted("record_view")).run_if(is_view_due),
            record_picture.pipe(counted("record_picture")).run_if(is_picture_due),
        )
            .in_set(Phase::Present),
    );
}

fn is_view_due(progress: Single<&FilmProgress, With<Film>>, viewed: Res<Viewed>) -> bool {
    viewed.0 != ViewMode::Beauty && progress.shown != Some(viewed.0)
}

fn record_view(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    geometry: Res<SceneGeometry>,
    shot: Res<Shot>,
    viewed: Res<Viewed>,
    chosen: Res<ProbeChosen>,
) -> Result<(), EngineError> {
    match viewed.0 {
        ViewMode::Debug => {
            let size = shot.size();
            for (name, bytes) in debug::buffers(u64::from(size.x) * u64::from(size.y)) {
                device.0.reserve(name, bytes)?;
            }
            debug::record(&mut frame.picture, &shot.params);
        }
        ViewMode::Probe => record_probe(&mut device.0, &mut frame.picture, &mut progress, &shot, &chosen)?,
        mode => view::record(&mut frame.picture, &view_params(&geometry, &shot, mode)),
    }
    progress.shown = Some(viewed.0);
    Ok(())
}

/// Numbers that code shows, where those that there are were not asked for so; and their picture.
fn record_probe(
    device: &mut Runtime,
    picture: &mut Recording,
    progress: &mut FilmProgress,
    shot: &Shot,
    chosen: &ProbeChosen,
) -> Result<(), EngineError> {
    let (size, look) = (shot.size(), chosen.0.as_ref().map(|chosen| chosen.look).unwrap_or_default());
    for (name, bytes) in probe::buffers(u64::from(size.x) * u64::from(size.y)) {
        device.reserve(name, bytes)?;
    }
    let asked = look.choice(chosen.number(device).unwrap_or(NO_PROBE));
    let words = [asked.name, asked.bounce, asked.part];
    if progress.probed != Some(words) {
        device.upload("probe_asked", &[asked])?;
        probe::record(picture, &shot.params);
        progress.probed = Some(words);
    }
    probe::record_colours(picture, &look.colours(size.x * size.y));
    Ok(())
}

fn is_picture_due(
    progress: Single<&FilmProgress, With<Film>>,
    viewed: Res<Viewed>,
    live: Res<Live>,
    target: Res<Target>,
) -> bool {
    viewed.0 == ViewMode::Beauty
        && progress.shown != Some(ViewMode::Beauty)
        && progress.shows().is_some()
        && (live.0 || progress.samples >= target.0)
}

fn record_picture(
    mut frame: ResMut<Frame>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    shot: Res<Shot>,
    displayed: Res<Displayed>,
) {
    let shown = progress.shows().unwrap_or_default();
    film::record_display(&mut frame.picture, &shot.display_params(shown, displayed.0));
    progress.shown = Some(ViewMode::Beauty);
}

/// What the pass `view` is given.
pub fn view_params(geometry: &SceneGeometry, shot: &Shot, mode: ViewMode) -> ViewParams {
    ViewParams { trace_params: shot.params, mode: mode as u32, reach: reach(geometry), pad0: 0, pad1: 0 }
}

/// The distance that view "depth" shows as 1/2, scene units: the scene's size.
pub fn reach(geometry: &SceneGeometry) -> f32 {
    let size = (geometry.high - geometry.low).length() as f32;
    if size.is_normal() { size } else { 1.0 }
}
