//! One member, from its first sample to its goal.

use std::time::Duration;

use bevy_ecs::change_detection::DetectChangesMut;

use super::record::Snapshot;
use super::stage::{Stage, Tally};
use super::watcher::Watcher;
use crate::components::Render;
use crate::engine::{EngineError, FilmImage};
use crate::scene::variants::Goal;
use crate::stats::looks::{FIRST_LOOK, MOST_SPP, next_look};

/// Tracing between two polls of signals.
const STEP: Duration = Duration::from_millis(100);

/// A film at its goal.
pub struct Traced {
    pub film: FilmImage,
    pub snapshots: Vec<Snapshot>,
    pub bad_samples: u64,
}

/// Traces what is on the stage. `render` is its scene's. None after a signal.
///
/// What is looked at follows from the goal alone, and never from the clock where that is no goal: films are the same to the bit, in one run
/// or in several.
/// `before` is what the stage had done when the member was put on it.
pub fn trace(
    stage: &mut Stage,
    before: &Tally,
    render: Render,
    goal: &Goal,
    watcher: &Watcher,
) -> Result<Option<Traced>, EngineError> {
    warm_up(stage, before)?;
    let mut snapshots = Vec::new();
    match goal {
        Goal::Samples(looks) => {
            for spp in looks {
                if !reach(stage, Render { spp: *spp, ..render }, None, watcher)? {
                    return Ok(None);
                }
                if looks.last() != Some(spp) {
                    snapshots.push(look(stage)?);
                }
            }
        }
        Goal::Seconds(looks) => {
            for seconds in looks {
                if !reach(stage, Render { spp: u32::MAX, ..render }, Some(*seconds), watcher)? {
                    return Ok(None);
                }
                if looks.last() != Some(seconds) {
                    snapshots.push(look(stage)?);
                }
            }
        }
        Goal::Error(error) => {
            let mut spp = FIRST_LOOK;
            loop {
                if !reach(stage, Render { spp, ..render }, None, watcher)? {
                    return Ok(None);
                }
                let bound = stage.engine.film_error()?.bound;
                if spp >= MOST_SPP || bound <= *error {
                    break;
                }
                spp = next_look(spp, bound / error);
            }
        }
    }
    let (film, report) = (stage.engine.film()?, stage.engine.report()?);
    snapshots.push(snapshot(stage, &film, report.rays));
    Ok(Some(Traced { film, snapshots, bad_samples: report.bad_samples }))
}

/// The picture of a film that is finished already: only its exposure is another. None where there is no such film.
pub fn retake(stage: &mut Stage, before: &Tally) -> Result<Option<(FilmImage, u64)>, EngineError> {
    let step = stage.engine.step(Duration::ZERO)?;
    if !step.finished || stage.began(before) {
        return Ok(None);
    }
    Ok(Some((stage.engine.film()?, stage.engine.report()?.bad_samples)))
}

/// Compiles what is missing. Some drivers compile a kernel when it first runs: what was traced meanwhile is traced again, so that no
/// member's seconds are those of a compiler.
fn warm_up(stage: &mut Stage, before: &Tally) -> Result<(), EngineError> {
    stage.engine.step(Duration::ZERO)?;
    if stage.compiled(before) {
        stage.engine.restart_film();
    }
    Ok(())
}

/// Traces until every pixel has its samples, or the film has taken so many seconds and every pixel has one. False after a signal.
fn reach(stage: &mut Stage, render: Render, seconds: Option<f64>, watcher: &Watcher) -> Result<bool, EngineError> {
    stage.engine.edit(|world| {
        for mut held in world.query::<&mut Render>().iter_mut(world) {
            held.set_if_neq(render);
        }
    });
    loop {
        let left = seconds.map_or(STEP.as_secs_f64(), |seconds| seconds - stage.engine.film_seconds());
        let step = stage.engine.step(STEP.min(Duration::from_secs_f64(left.max(0.0))))?;
        watcher.advance(step.samples, step.spp);
        let over = seconds.is_some_and(|seconds| stage.engine.film_seconds() >= seconds);
        if step.finished || over && step.spp >= 1 {
            return Ok(true);
        }
        if watcher.interrupt.requested() {
            return Ok(false);
        }
    }
}

/// The film as it is.
fn look(stage: &mut Stage) -> Result<Snapshot, EngineError> {
    let (film, report) = (stage.engine.film()?, stage.engine.report()?);
    Ok(snapshot(stage, &film, report.rays))
}

fn snapshot(stage: &Stage, film: &FilmImage, rays: u64) -> Snapshot {
    Snapshot { spp: film.spp, seconds: stage.engine.film_seconds(), rays, relmse: film.error.relmse }
}
