//! `lucerna watch`: the engine without a window, for tests and for editors' tools. One JSON object a line and event.

use std::io::Write;
use std::sync::mpsc::channel;
use std::time::Duration;

use clap::Args;
use serde_json::{Value, json};

use crate::app::shared::compiling::{is_due, line, watch_compiling};
use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::scene::SceneFlags;
use crate::app::shared::textures::TextureNotices;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::engine::{Engine, EngineError, Progress};
use crate::gpu::{Gpu, GpuError};
use crate::watch::{Problem, ReloadEvent, Restarts};

#[derive(Debug, Args)]
#[command(after_help = MORE, allow_negative_numbers = true)]
pub struct WatchArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// No messages on stderr beside the events
    #[arg(long, short)]
    pub quiet: bool,
}

/// Tracing between two polls of what was saved.
const STEP: Duration = Duration::from_millis(30);

/// Between two polls of signals, while there is nothing to trace.
const IDLE: Duration = Duration::from_millis(200);

/// Renders until a signal comes, or nobody reads the events any more.
pub fn run(arguments: &WatchArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Done);
    let opened = arguments.flags.open(&arguments.scene, arguments.quiet)?;
    let library = arguments.flags.library(&opened)?;
    let gpu = Gpu::open()?;
    let mut engine = Engine::open(gpu, library.clone(), &opened.description).map_err(Failure::engine)?;
    let quiet = arguments.quiet;
    engine.on_compiling(watch_compiling(move |seconds| {
        if is_due(seconds) {
            let since = Duration::from_secs(seconds);
            // Nobody may be left to read it: the next event finds out.
            emit(&as_json(&ReloadEvent::Compiling { files: Vec::new(), since, given_up: 0, warnings: Vec::new() }));
            if !quiet {
                output::note(&line(seconds));
            }
        }
    }));
    // What is wrong from the start ends it: there is nothing yet to go on with.
    let mut step = engine.step(STEP).map_err(Failure::engine)?;
    let size = opened.description.film.size;
    let started = json!({ "event": "watching", "scene": opened.path.display().to_string(), "size": [size.x, size.y] });
    let (wake, woken) = channel();
    engine
        .watch(arguments.flags.sources(opened, library), move || {
            let _ = wake.send(());
        })
        .map_err(Failure::of)?;
    if !emit(&started) {
        return Ok(Exit::Done);
    }
    let mut notices = TextureNotices::default();
    while !interrupt.requested() {
        if !tell_textures(&notices.fresh(engine.textures(), engine.halved_sky()), quiet) {
            return Ok(Exit::Done);
        }
        if step.finished && step.samples > 0 && !emit(&json!({ "event": "finished", "spp": step.spp })) {
            return Ok(Exit::Done);
        }
        if step.finished && step.dispatches == 0 {
            // Whether it was woken or the time is up, the next step finds out.
            let _ = woken.recv_timeout(IDLE);
        }
        let stepped = engine.step(STEP);
        for event in engine.events() {
            if !arguments.quiet {
                show_problems(&event);
            }
            if !emit(&as_json(&event)) {
                return Ok(Exit::Done);
            }
        }
        step = match stepped {
            Ok(step) => step,
            Err(lost @ EngineError::Gpu(GpuError::Lost { .. })) => return Err(Failure::engine(lost)),
            Err(error) => {
                let event = failure(Problem::from(error));
                if !arguments.quiet {
                    show_problems(&event);
                }
                if !emit(&as_json(&event)) {
                    return Ok(Exit::Done);
                }
                // Until something is saved, it would fail again.
                while !engine.has_saves() && !interrupt.requested() {
                    let _ = woken.recv_timeout(IDLE);
                }
                Progress { samples: 0, ..step }
            }
        };
    }
    Ok(Exit::Done)
}

/// An error of the engine that no save can be held to.
fn failure(problem: Problem) -> ReloadEvent {
    ReloadEvent::Failed { files: Vec::new(), problems: vec![problem], since_save: Duration::ZERO }
}

/// Tells what was done to textures. False if nobody reads it.
fn tell_textures(warnings: &[String], quiet: bool) -> bool {
    if !quiet {
        warnings.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
    }
    let placeless = |message: &String| json!({ "file": null, "line": 0, "column": 0, "message": message });
    let warnings: Vec<Value> = warnings.iter().map(placeless).collect();
    warnings.is_empty() || emit(&json!({ "event": "textures", "warnings": warnings }))
}

/// Writes a line to stdout. False if nobody reads it.
fn emit(event: &Value) -> bool {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{event}").and_then(|()| out.flush()).is_ok()
}

fn show_problems(event: &ReloadEvent) {
    let problems = match event {
        ReloadEvent::Failed { problems, .. } => problems,
        ReloadEvent::Reloaded { warnings, .. } | ReloadEvent::Linted { warnings, .. } => warnings,
        ReloadEvent::Compiling { .. } | ReloadEvent::FirstPixels { .. } => return,
    };
    problems.iter().for_each(|problem| show(&*problem.diagnostic));
}

/// An event as programs get it. The first problem of several stands in the event itself too.
fn as_json(event: &ReloadEvent) -> Value {
    match event {
        ReloadEvent::Reloaded { files, restarts, warnings, since_save } => json!({
            "event": "reloaded",
            "files": files,
            "restarts": parts(restarts),
            "warnings": warnings.iter().map(problem).collect::<Vec<_>>(),
            "milliseconds": milliseconds(*since_save),
        }),
        ReloadEvent::Failed { files, problems, since_save } => {
            let mut event = json!({
                "event": "failed",
                "files": files,
                "problems": problems.iter().map(problem).collect::<Vec<_>>(),
                "milliseconds": milliseconds(*since_save),
            });
            if let (Some(first), Some(event)) = (problems.first(), event.as_object_mut())
                && let Value::Object(fields) = problem(first)
            {
                event.extend(fields);
            }
            event
        }
        ReloadEvent::Compiling { files, since, given_up, warnings } => json!({
            "event": "compiling",
            "files": files,
            "seconds": since.as_secs(),
            "given_up": given_up,
            "warnings": warnings.iter().map(problem).collect::<Vec<_>>(),
        }),
        ReloadEvent::FirstPixels { since_save } => {
            json!({ "event": "first_pixels", "milliseconds": milliseconds(*since_save) })
        }
        ReloadEvent::Linted { warnings, took } => json!({
            "event": "linted",
            "warnings": warnings.iter().map(problem).collect::<Vec<_>>(),
            "milliseconds": milliseconds(*took),
        }),
    }
}

fn parts(restarts: &Restarts) -> Vec<&'static str> {
    let parts = [(restarts.tree, "tree"), (restarts.film, "film"), (restarts.picture, "picture")];
    parts.into_iter().filter_map(|(on, name)| on.then_some(name)).collect()
}

fn problem(problem: &Problem) -> Value {
    json!({ "file": problem.file, "line": problem.line, "column": problem.column, "message": problem.message })
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e4).round() / 10.0
}
