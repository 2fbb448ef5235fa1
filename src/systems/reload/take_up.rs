//! Puts in place what the worker made, and puts aside what it replaces.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::aside::put_aside;
use super::state::{Reload, Taken};
use crate::components::ShaderValues;
use crate::gpu::Code;
use crate::scene::{self, Diagnostic, Loaded, Severity};
use crate::systems::code::restarts_of;
use crate::systems::resources::{Device, FilmProgress, Shot};
use crate::watch::{News, Outcome, Problem, ReloadEvent, Restarts, values};

/// Takes up all that the worker has sent, unless that is held.
pub fn take_up_saves(world: &mut World) {
    world.resource_scope(|world, mut reload: Mut<Reload>| {
        let linted = reload.linter.take();
        reload.events.extend(linted);
        let news = if reload.held { Vec::new() } else { reload.watch.news() };
        for news in news {
            match news {
                News::Ready(outcome) => take_up(world, &mut reload, *outcome),
                News::Compiling { files, since, given_up, warnings } => {
                    reload.events.push(ReloadEvent::Compiling { files, since, given_up, warnings });
                }
            }
        }
    });
}

fn take_up(world: &mut World, reload: &mut Reload, outcome: Outcome) {
    let Outcome { saved, mut code, mut scene, warnings: slow, tied, again } = refuse_unfit(world, outcome);
    if reload.undone && !tied && (matches!(code, Some((_, Ok(_)))) || matches!(scene, Some((_, Ok(_))))) {
        // It was read before the worker knew.
        code = code.filter(|(_, code)| code.is_err());
        scene = scene.filter(|(_, scene)| scene.is_err());
        reload.watch.choose();
    }
    if tied && matches!((&code, &scene), (Some((_, Ok(_))), Some((_, Ok(_))))) {
        (reload.undone, reload.trial.tied) = (false, true);
    }
    let (mut good, mut bad) = (Vec::new(), Vec::new());
    let (mut any_good, mut problems, mut warnings) = (false, Vec::new(), Vec::new());
    match code {
        Some((files, Ok(code))) => {
            (any_good, good, warnings) = (true, files, slow);
            // What the files hold may be as wrong as before.
            if !again {
                reload.problems.code.clear();
            }
            let unfit = put_code_and_tell_unfit(world, reload, code);
            warnings.extend(unfit.into_iter().filter(|_| scene.is_none()));
            // A scene that had to give way may do so no longer.
            if std::mem::take(&mut reload.retry_scene) {
                reload.force();
            }
        }
        Some((files, Err(found))) => {
            bad = files;
            problems.extend(found.iter().cloned());
            if !again {
                reload.problems.code = found;
            }
        }
        None => {}
    }
    match scene {
        Some((files, Ok(loaded))) => {
            any_good = true;
            good.extend(files);
            reload.problems.scene.clear();
            warnings.extend(put_scene(world, reload, *loaded));
            if std::mem::take(&mut reload.retry_code) {
                reload.force();
            }
        }
        Some((files, Err(found))) => {
            bad.extend(files);
            problems.extend(found.iter().cloned());
            reload.problems.scene = found;
        }
        None => {}
    }
    if any_good {
        reload.trial.files.clone_from(&good);
        reload.taken.push(Taken { saved, files: good, warnings });
    }
    if !problems.is_empty() {
        reload.refused.push(ReloadEvent::Failed { files: bad, problems, since_save: saved.elapsed() });
    }
}

/// Refuses a scene that sets what its shaders have not, or can't be set to; code that is tied to it goes with it.
fn refuse_unfit(world: &World, mut outcome: Outcome) -> Outcome {
    let parameters = match &outcome.code {
        Some((_, Ok(code))) => code.parameters(),
        _ => world.resource::<Device>().0.parameters().clone(),
    };
    let fit = |scene: Box<Loaded>| {
        let unfit = values::unfit(&scene.description.shader, &scene.shader_places, &parameters);
        if unfit.is_empty() { Ok(scene) } else { Err(unfit.into_iter().map(Problem::from).collect()) }
    };
    outcome.scene = outcome.scene.map(|(files, scene)| (files, scene.and_then(fit)));
    if outcome.tied && matches!(outcome.scene, Some((_, Err(_)))) {
        outcome.code = outcome.code.filter(|(_, code)| code.is_err());
    }
    outcome
}

/// Values of parameters that the shaders which run have no use for: edits of shaders may leave such behind.
fn unfit_now(world: &mut World) -> Vec<Diagnostic> {
    let set = world.query::<&ShaderValues>().iter(world).next().cloned().unwrap_or_default();
    values::unfit(&set, &BTreeMap::new(), world.resource::<Device>().0.parameters())
}

/// Puts other code in place. Returns warnings of values that had a use until now, and have none by this code.
fn put_code_and_tell_unfit(world: &mut World, reload: &mut Reload, code: Code) -> Vec<Problem> {
    let before = unfit_now(world);
    put_code(world, reload, code);
    let is_new = |unfit: &Diagnostic| !before.iter().any(|known| known.message == unfit.message);
    let warning = |unfit: Diagnostic| {
        let message = format!("{}; the default counts, if there is one", unfit.message);
        Diagnostic { severity: Severity::Warning, message, ..unfit }.into()
    };
    unfit_now(world).into_iter().filter(is_new).map(warning).collect()
}

/// Runs other code from now on, and puts the film aside that the old code made.
fn put_code(world: &mut World, reload: &mut Reload, code: Code) {
    let (old, changed) = world.resource_mut::<Device>().0.replace(code);
    reload.linter.forget();
    reload.code_restarts = reload.code_restarts.with(restarts_of(&changed));
    if reload.trial.code.is_some() && !reload.trial.passed {
        // What is gone back to is still the last that worked, and the film has samples of both since.
        reload.trial.restarts = reload.trial.restarts.with(reload.code_restarts);
        return;
    }
    reload.trial.code = Some(old);
    // What runs is the same: only what a scene may ask for later is other code.
    reload.trial.passed = reload.code_restarts == Restarts::default() && !reload.trial.tied;
    reload.trial.restarts = reload.code_restarts;
    if reload.code_restarts.film {
        let kept = put_aside(&mut world.resource_mut::<Device>().0);
        let progress = world.query::<&FilmProgress>().iter(world).next().copied();
        // Of an adaptive film more is to be kept than its pixels: it starts anew.
        reload.trial.film = progress.filter(|_| kept && !world.resource::<Shot>().is_adaptive());
    }
}

/// Makes the world hold another scene, but for what was edited beside the files and is the same in both. Returns what was
/// not taken as written.
fn put_scene(world: &mut World, reload: &mut Reload, loaded: Loaded) -> Vec<Problem> {
    scene::apply_changes(world, reload.description.as_ref(), &loaded.description);
    let old = reload.description.replace(loaded.description);
    let old_text = std::mem::replace(&mut reload.text, loaded.text);
    if reload.trial.scene.is_none() {
        reload.trial.scene = old.map(|old| (old, old_text));
    }
    loaded.warnings.into_iter().map(Problem::from).collect()
}
