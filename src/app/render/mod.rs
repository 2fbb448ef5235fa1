//! `lucerna render`: drives the schedule until the film is finished, and saves it.

mod arguments;
pub mod report;
mod until;

pub use arguments::RenderArguments;

use std::path::Path;
use std::time::{Duration, Instant};

use crate::app::shared::compiling::watch_compiling;
use crate::app::shared::interrupt::{Interrupt, leave_running};
use crate::app::shared::opening::Opening;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::progress::Meter;
use crate::app::shared::scene::Opened;
use crate::app::shared::textures::TextureNotices;
use crate::app::{Exit, Failure};
use crate::components::Render;
use crate::engine::{Engine, ErrorSources, FilmError, Progress, Surveyed};
use crate::image::{Output, Outputs, Picture, SaveError};
use crate::scene::SceneDescription;
use report::{RenderSummary, Seconds};
use until::{Ended, Next, Until};

/// Tracing between two polls of the clock and of signals.
const STEP: Duration = Duration::from_millis(100);

/// Paths that are traced between two polls, to find out where the error comes from.
const MOST_PATHS: u64 = 1 << 17;

/// What is said where there is nothing to write.
const NOTHING: &str = "interrupted before there was anything to write";

/// Loads, renders, saves and reports. `started` is when the process began.
pub fn run(arguments: &RenderArguments, started: Instant) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    if arguments.quality.is_some() && arguments.flags.gives_samples() {
        let message = "--quality and the number of samples both say when the render ends";
        return Err(Failure::usage(message, "give one of --quality and --spp (or -D render.spp)"));
    }
    let opening = Opening::begin();
    let begin = Instant::now();
    let opened = arguments.flags.open(&arguments.scene, arguments.quiet)?;
    let library = arguments.flags.library(&opened)?;
    let Opened { path, mut description, files, spp, .. } = opened;
    let until = Until::of(arguments, spp);
    description.render.spp = until.first();
    let (mut outputs, prepared) = output::prepare(&outputs(arguments, &path)?, &files)?;
    let load = begin.elapsed();

    let (gpu, start) = opening.finish()?;
    let begin = Instant::now();
    let mut engine = Engine::open(gpu.clone(), library, &description).map_err(Failure::engine)?;
    engine.set_timing(true);
    engine.set_robust(arguments.robust);
    let load = load + begin.elapsed();

    let (ended, estimate) = trace(&mut engine, &description, (until, arguments.quiet), &interrupt, started)?;
    let begin = Instant::now();
    let film = engine.film().map_err(Failure::engine)?;
    if !arguments.quiet {
        let unread = parameters::unread(&description.shader, &engine);
        unread.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
    }
    let robust = engine.robust_film().map_err(Failure::engine)?;
    let read = begin.elapsed();
    let sources = match arguments.sources && ended != Ended::Interrupted {
        true => sources(&mut engine, &interrupt)?,
        false => None,
    };
    let surveyed = begin.elapsed() - read;
    let report = engine.report().map_err(Failure::engine)?;
    if report.samples == 0 {
        output::note(NOTHING);
        return Ok(Exit::Interrupted);
    }
    let seconds = Seconds {
        start: start.as_secs_f64(),
        load: load.as_secs_f64(),
        estimate: estimate.as_secs_f64(),
        read: (begin.elapsed() - surveyed).as_secs_f64(),
        sources: surveyed.as_secs_f64(),
        total: started.elapsed().as_secs_f64(),
    };
    let interrupted = ended == Ended::Interrupted;
    let summary = RenderSummary {
        arguments,
        path: &path,
        description: &description,
        film: &film,
        report: &report,
        sources: sources.as_ref(),
        robust: robust.as_ref(),
        seconds,
        until,
        ended,
    };
    // Drivers take a tenth of a second to close a device.
    let may_be_left = gpu.may_be_left_open();
    leave_running(may_be_left);
    let closing = std::thread::spawn(move || drop((engine, gpu)));
    let saved = save_and_report(&summary, &mut outputs);
    if !may_be_left {
        closing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    }
    Ok(match (saved? && prepared, interrupted) {
        (false, _) => Exit::Failed,
        (true, true) => Exit::Interrupted,
        (true, false) => Exit::Done,
    })
}

/// Finds out where the film's error comes from; none where a signal came first.
fn sources(engine: &mut Engine, interrupt: &Interrupt) -> Result<Option<ErrorSources>, Failure> {
    let Some(mut survey) = engine.begin_survey(MOST_PATHS).map_err(Failure::engine)? else { return Ok(None) };
    while !interrupt.requested() {
        if engine.survey(&mut survey).map_err(Failure::engine)? != Surveyed::More {
            return Ok(Some(engine.sources(&survey)));
        }
    }
    Ok(None)
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
    let whole = output::all_written(outputs.write(&picture, |written| summary.json(written)));
    let arguments = summary.arguments;
    if !arguments.quiet {
        summary.bad_lines().iter().for_each(|line| output::note(line));
    }
    if summary.ended == Ended::Interrupted && !arguments.quiet {
        let of = summary.until.spp.map_or(String::new(), |spp| format!(" of {spp}"));
        output::note(&format!("interrupted at {}{of} spp", summary.film.spp));
    }
    match arguments.json {
        true => output::print(&format!("{}\n", summary.json(outputs)))?,
        false => output::print(&summary.text(outputs, arguments.stats))?,
    }
    Ok(whole)
}

/// What a render needs while it traces.
struct Tracing<'r> {
    engine: &'r mut Engine,
    meter: Meter,
    until: Until,
    interrupt: &'r Interrupt,
    /// Spent on reading the film's error.
    looking: Duration,
}

/// Steps until the film is finished, the time is up, or a signal comes; says which, and what it took to read the film's error meanwhile.
/// `started` is when the process began.
fn trace(
    engine: &mut Engine,
    description: &SceneDescription,
    (until, quiet): (Until, bool),
    interrupt: &Interrupt,
    started: Instant,
) -> Result<(Ended, Duration), Failure> {
    let size = description.film.window().size();
    let pixels = u64::from(size.x) * u64::from(size.y);
    let meter = Meter::new(&description.name, until.goal(pixels, started.elapsed().as_secs_f64()), quiet);
    engine.on_compiling(watch_compiling(meter.show_compiling()));
    let mut tracing = Tracing { engine, meter, until, interrupt, looking: Duration::ZERO };
    // Nothing is traced yet: what there is room for is known before long work begins.
    let mut told = quiet;
    loop {
        let (step, over) = tracing.step()?;
        if !std::mem::replace(&mut told, true) {
            let engine = &tracing.engine;
            let warnings = TextureNotices::default().fresh(engine.textures(), engine.halved_sky());
            warnings.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
        }
        if let Some(ended) = tracing.ended(step, over)? {
            tracing.meter.finish();
            return Ok((ended, tracing.looking));
        }
        if tracing.meter.wants_error() {
            tracing.look()?;
        }
    }
}

impl Tracing<'_> {
    /// Traces for a moment. Also says whether the time is up.
    fn step(&mut self) -> Result<(Progress, bool), Failure> {
        let left = self.meter.seconds_left().map_or(STEP, Duration::from_secs_f64);
        let step = self.engine.step(STEP.min(left)).map_err(Failure::engine)?;
        self.meter.advance(step.samples, step.spp);
        if step.samples > 0 {
            self.interrupt.hold();
        }
        Ok((step, left.is_zero()))
    }

    /// Whether the render is finished, and why. A film that is to have more samples first is given them.
    fn ended(&mut self, step: Progress, over: bool) -> Result<Option<Ended>, Failure> {
        if step.finished {
            let until = self.until;
            match until.next(step.spp, || self.look())? {
                Next::End(ended) => return Ok(Some(ended)),
                Next::Samples(spp) => self.engine.edit(|world| {
                    for mut render in world.query::<&mut Render>().iter_mut(world) {
                        render.spp = spp;
                    }
                }),
            }
        }
        Ok(match (self.interrupt.requested(), over) {
            (true, _) => Some(Ended::Interrupted),
            // Short of time, every pixel still gets one sample.
            (false, true) if step.spp >= 1 => Some(Ended::Time),
            (false, _) => None,
        })
    }

    /// Reads the film's error, and shows it.
    fn look(&mut self) -> Result<FilmError, Failure> {
        let begin = Instant::now();
        let error = self.engine.film_error().map_err(Failure::engine)?;
        self.looking += begin.elapsed();
        self.meter.set_error(error, begin.elapsed());
        Ok(error)
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
