//! `lucerna render`: drives the schedule until the film is finished, and saves it.

mod arguments;
pub mod report;

pub use arguments::RenderArguments;

use std::path::Path;
use std::time::{Duration, Instant};

use crate::app::shared::compiling::watch_compiling;
use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::scene::Opened;
use crate::app::shared::textures::TextureNotices;
use crate::app::{Exit, Failure};
use crate::engine::Engine;
use crate::gpu::Gpu;
use crate::image::{Output, Outputs, Picture, SaveError};
use crate::scene::SceneDescription;
use report::{RenderSummary, Seconds};

/// Tracing between two polls of the clock and of signals.
const STEP: Duration = Duration::from_millis(100);

/// What is said where there is nothing to write.
const NOTHING: &str = "interrupted before there was anything to write";

/// How tracing ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ended {
    Finished,
    Interrupted,
}

/// Loads, renders, saves and reports. `started` is when the process began.
pub fn run(arguments: &RenderArguments, started: Instant) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let begin = Instant::now();
    let opened = arguments.flags.open(&arguments.scene, arguments.quiet)?;
    let library = arguments.flags.library(&opened)?;
    let Opened { path, mut description, files, .. } = opened;
    if arguments.time.is_some() && !arguments.flags.settings.gives("spp") {
        // The scene's own number of samples is no limit.
        description.render.spp = u32::MAX;
    }
    let (mut outputs, prepared) = output::prepare(&outputs(arguments, &path)?, &files)?;
    let load = begin.elapsed();

    let begin = Instant::now();
    let gpu = Gpu::open()?;
    let start = begin.elapsed();
    let begin = Instant::now();
    let mut engine = Engine::open(gpu, library, &description).map_err(Failure::engine)?;
    engine.set_timing(true);
    let load = load + begin.elapsed();

    let ended = trace(&mut engine, &description, arguments, &interrupt)?;
    let film = engine.film().map_err(Failure::engine)?;
    if !arguments.quiet {
        let unread = parameters::unread(&description.shader, &engine);
        unread.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
    }
    let report = engine.report().map_err(Failure::engine)?;
    if report.samples == 0 {
        output::note(NOTHING);
        return Ok(Exit::Interrupted);
    }
    let seconds =
        Seconds { start: start.as_secs_f64(), load: load.as_secs_f64(), total: started.elapsed().as_secs_f64() };
    let interrupted = ended == Ended::Interrupted;
    let summary = RenderSummary {
        arguments,
        path: &path,
        description: &description,
        film: &film,
        report: &report,
        seconds,
        interrupted,
    };
    let saved = save_and_report(&summary, &mut outputs)?;
    Ok(match (saved && prepared, interrupted) {
        (false, _) => Exit::Failed,
        (true, true) => Exit::Interrupted,
        (true, false) => Exit::Done,
    })
}

/// Writes the files, then says so; whether all were written.
fn save_and_report(summary: &RenderSummary, outputs: &mut Outputs) -> Result<bool, Failure> {
    let metadata = summary.metadata();
    let picture = Picture {
        size: summary.film.size,
        window: summary.film.window,
        linear: &summary.film.rgb,
        display: &summary.film.picture,
        metadata: &metadata,
        report: &serde_json::Value::Null,
    };
    let failures = outputs.write(&picture, |names| summary.json(names));
    failures.iter().for_each(|failure| show(failure));
    let names = outputs.names();
    let arguments = summary.arguments;
    if summary.report.bad_samples > 0 && !arguments.quiet {
        output::note(&format!(
            "warning: {} samples were no numbers, or too large, and were left out; --json lists the first",
            summary.report.bad_samples
        ));
    }
    if summary.interrupted && !arguments.quiet {
        output::note(&format!("interrupted at {} of {} spp", summary.film.spp, summary.description.render.spp));
    }
    match arguments.json {
        true => output::print(&format!("{}\n", summary.json(&names)))?,
        false => output::print(&summary.text(&names, arguments.stats))?,
    }
    Ok(failures.is_empty())
}

/// Steps until the film is finished, the time is up, or a signal comes.
fn trace(
    engine: &mut Engine,
    description: &SceneDescription,
    arguments: &RenderArguments,
    interrupt: &Interrupt,
) -> Result<Ended, Failure> {
    let size = description.film.window().size();
    let pixels = u64::from(size.x) * u64::from(size.y);
    let by_samples = arguments.time.is_none() || arguments.flags.settings.gives("spp");
    let goal = Goal {
        samples: by_samples.then(|| pixels.saturating_mul(u64::from(description.render.spp))),
        seconds: arguments.time,
    };
    let mut meter = Meter::new(&description.name, goal, arguments.quiet);
    engine.on_compiling(watch_compiling(meter.show_compiling()));
    // Nothing is traced yet: what there is room for is known before long work begins.
    let mut told = arguments.quiet;
    loop {
        let left = arguments.time.map_or(STEP, |time| Duration::from_secs_f64(time).saturating_sub(meter.elapsed()));
        let step = engine.step(STEP.min(left)).map_err(Failure::engine)?;
        if !std::mem::replace(&mut told, true) {
            let warnings = TextureNotices::default().fresh(engine.textures(), engine.halved_sky());
            warnings.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
        }
        meter.advance(step.samples, step.spp);
        if step.samples > 0 {
            interrupt.hold();
        }
        let ended = match (step.finished, interrupt.requested()) {
            (true, _) => Some(Ended::Finished),
            (false, true) => Some(Ended::Interrupted),
            // Short of time, every pixel still gets one sample.
            (false, false) if arguments.time.is_some() && left.is_zero() && step.spp >= 1 => Some(Ended::Finished),
            (false, false) => None,
        };
        if let Some(ended) = ended {
            meter.finish();
            return Ok(ended);
        }
        if meter.wants_error() {
            let begin = Instant::now();
            let error = engine.film().map_err(Failure::engine)?.relative_error;
            meter.set_error(error, begin.elapsed());
        }
    }
}

/// The files to write: those named, else `result/SCENE` in all three kinds.
fn outputs(arguments: &RenderArguments, path: &Path) -> Result<Vec<Output>, SaveError> {
    if !arguments.output.is_empty() {
        return Ok(arguments.output.clone());
    }
    let stem = path.file_stem().unwrap_or_default();
    let named = |extension: &str| {
        let mut name = stem.to_owned();
        name.push(".");
        name.push(extension);
        Output::new(Path::new("result").join(name))
    };
    ["png", "exr", "json"].into_iter().map(named).collect()
}
