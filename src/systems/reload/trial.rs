//! The trial of what was put in place: it ends once every pixel has a sample, and an error brings back what was there before.

use bevy_ecs::prelude::*;

use super::aside::bring_back;
use super::state::Reload;
use crate::components::Film;
use crate::gpu::GpuError;
use crate::scene;
use crate::shader::ErrorKind;
use crate::systems::error::EngineError;
use crate::systems::resources::{Batch, Device, FilmProgress, Governor, Target, Tree};
use crate::systems::restart::start_again;
use crate::watch::{Problem, ReloadEvent};

/// Ends the trial once every pixel has a sample.
pub fn end_trial(mut reload: ResMut<Reload>, progress: Single<&FilmProgress, With<Film>>) {
    if progress.samples > 0 {
        reload.trial.scene = None;
        reload.trial.film = None;
        reload.trial.passed = true;
        // What was there before is gone: its scene is, too.
        if std::mem::take(&mut reload.trial.tied) {
            reload.trial.code = None;
        }
    }
}

/// Brings back what was there before what is on trial, if an error may come from that; else gives the error back.
///
/// A loop that does not end shows late where few pixels come to it: code can be taken back for that even after its trial.
pub fn go_back(world: &mut World, error: EngineError) -> Result<(), EngineError> {
    let Some(mut reload) = world.remove_resource::<Reload>() else { return Err(error) };
    let endless = is_endless(&error);
    let lost = matches!(error, EngineError::Gpu(GpuError::Lost { .. }));
    let code = reload.trial.code.take_if(|_| !reload.trial.passed || endless);
    let tied = reload.trial.tied && code.is_some();
    let scene = reload.trial.scene.take_if(|_| tied || !endless || code.is_none());
    if lost || code.is_none() && scene.is_none() {
        world.insert_resource(reload);
        return Err(error);
    }
    let problem = Problem::from(error);
    let (had_code, had_scene) = (code.is_some(), scene.is_some());
    if let Some(code) = code {
        world.resource_mut::<Device>().0.replace(code);
        reload.linter.forget();
        reload.problems.code = vec![problem.clone()];
    }
    if let Some((scene, text)) = scene {
        scene::apply_changes(world, reload.description.as_ref(), &scene);
        (reload.description, reload.text) = (Some(scene), text);
        if !tied {
            reload.problems.scene = vec![problem.clone()];
        }
    }
    bring_film_back(world, &mut reload, endless, had_code);
    if tied {
        (reload.undone, reload.trial.tied) = (true, false);
        reload.watch.undone();
    } else {
        reload.retry_code |= had_code && !endless;
        reload.retry_scene |= had_scene;
    }
    world.resource_mut::<Governor>().forget();
    let saved = reload.awaited.take().or(reload.taken.first().map(|taken| taken.saved));
    let since_save = saved.map(|saved| saved.elapsed()).unwrap_or_default();
    reload.taken.clear();
    let refused = std::mem::take(&mut reload.refused);
    reload.events.extend(refused);
    let files = reload.trial.files.clone();
    reload.events.push(ReloadEvent::Failed { files, problems: vec![problem], since_save });
    world.insert_resource(reload);
    Ok(())
}

/// Makes the film what it was before the trial, or has it start anew where that can't be known.
fn bring_film_back(world: &mut World, reload: &mut Reload, endless: bool, had_code: bool) {
    // A batch is counted when it is recorded: where the tree failed, it was not traced.
    let untraced = !world.resource::<Tree>().built && !world.resource::<Batch>().is_empty();
    if had_code {
        world.resource_mut::<Tree>().built &= !reload.trial.restarts.tree;
    }
    let target = world.resource::<Target>().0;
    let is_wanted = |film: &FilmProgress| film.most_samples() <= target;
    match reload.trial.film.take().filter(|film| endless && is_wanted(film)) {
        Some(film) => {
            let restored = bring_back(&mut world.resource_mut::<Device>().0);
            let film = if restored { FilmProgress { shown: None, ..film } } else { FilmProgress::default() };
            set_progress(world, |progress| *progress = film);
        }
        // Code of the tree or of the picture: the film is what it was.
        None if endless && had_code && !reload.trial.restarts.film => {
            set_progress(world, |progress| match untraced {
                true => progress.restart(),
                false => progress.shown = None,
            });
        }
        None => start_again(world),
    }
}

fn set_progress(world: &mut World, change: impl Fn(&mut FilmProgress)) {
    world.query::<&mut FilmProgress>().iter_mut(world).for_each(|mut progress| change(&mut progress));
}

fn is_endless(error: &EngineError) -> bool {
    matches!(error, EngineError::Gpu(GpuError::Shader(error)) if error.kind == ErrorKind::Loop)
}

impl From<EngineError> for Problem {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Gpu(error) => error.into(),
            other => Problem::of(other),
        }
    }
}
