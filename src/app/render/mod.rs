//! `lucerna render`: drives the schedule until the film is finished, and saves it.

mod arguments;
pub mod bands;
mod errors;
mod left;
mod rendered;
pub mod report;
mod skipped;
mod trace;
mod until;

pub use arguments::RenderArguments;

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use crate::app::shared::compiling::watch_compiling;
use crate::app::shared::describe::Described;
use crate::app::shared::interrupt::{Interrupt, leave_running};
use crate::app::shared::opening::Opening;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::progress::Meter;
use crate::app::shared::scene::Opened;
use crate::app::{Exit, Failure};
use crate::components::Adaptive;
use crate::engine::{Engine, ErrorSources, FilmPart, Surveyed};
use crate::gpu::Gpu;
use crate::image::{Frame, Output, Outputs, Picture, Rows, SaveError, Strips};
use crate::process;
use crate::scene::SceneDescription;
use bands::Bands;
use rendered::Rendered;
use report::{RenderSummary, Seconds};
use trace::Tracing;
use until::{Ended, Until};

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
    let (outputs, prepared) = output::prepare(&outputs(arguments, &path)?, &files)?;
    let load = begin.elapsed();

    let (gpu, start) = opening.finish()?;
    let begin = Instant::now();
    let mut engine = Engine::open(gpu.clone(), library, &description).map_err(Failure::engine)?;
    engine.set_timing(true);
    engine.set_robust(arguments.robust);
    let load = load + begin.elapsed();

    let mut render = Render { arguments, path: &path, description: &description, gpu, until, outputs, strips: None };
    let rendered = render.trace(&mut engine, &interrupt, started)?;
    if !arguments.quiet {
        let unread = parameters::unread(&description.shader, &engine);
        unread.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
    }
    if render.has_no_files() {
        let failures =
            render.outputs.finish(render.strips.take().unwrap_or_default(), &[], |_| serde_json::Value::Null);
        output::all_written(failures);
        return Ok(Exit::Failed);
    }
    let (Some(report), false) = (&rendered.report, rendered.film.bands.is_empty()) else {
        output::note(NOTHING);
        return Ok(Exit::Interrupted);
    };
    // Of a film that was traced in bands, the device has the last one alone.
    let is_whole = rendered.whole.is_some();
    let robust = if is_whole { engine.robust_film().map_err(Failure::engine)? } else { None };
    let begin = Instant::now();
    let sources = match arguments.sources && is_whole && rendered.film.ended() != Ended::Interrupted {
        true => sources(&mut engine, &interrupt)?,
        false => None,
    };
    let surveyed = begin.elapsed();
    let seconds = Seconds {
        start: start.as_secs_f64(),
        load: load.as_secs_f64(),
        estimate: rendered.looking.as_secs_f64(),
        read: rendered.reading.as_secs_f64(),
        sources: surveyed.as_secs_f64(),
        total: started.elapsed().as_secs_f64(),
    };
    let Render { gpu, mut outputs, strips, .. } = render;
    let film = &rendered.film;
    let summary = RenderSummary {
        arguments,
        path: &path,
        description: &description,
        film,
        report,
        sources: sources.as_ref(),
        robust: robust.as_ref(),
        seconds,
        until,
        process_peak: process::peak(),
    };
    // Drivers take a tenth of a second to close a device.
    let may_be_left = gpu.may_be_left_open();
    leave_running(may_be_left);
    let closing = std::thread::spawn(move || drop((engine, gpu)));
    let saved = save_and_report(&summary, rendered.whole.as_ref(), strips, &mut outputs);
    if !may_be_left {
        closing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    }
    Ok(match (saved? && prepared, film.ended() == Ended::Interrupted) {
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

/// A render under way.
struct Render<'r> {
    arguments: &'r RenderArguments,
    path: &'r Path,
    description: &'r SceneDescription,
    gpu: Arc<Gpu>,
    until: Until,
    outputs: Outputs,
    /// The pictures that are written band by band; none where they are not, or not yet.
    strips: Option<Strips>,
}

impl Render<'_> {
    /// Traces the film; what is traced in bands is written as it comes. `started` is when the process began.
    fn trace(&mut self, engine: &mut Engine, interrupt: &Interrupt, started: Instant) -> Result<Rendered, Failure> {
        let (film, quiet) = (self.description.film, self.arguments.quiet);
        let size = film.window().size();
        let pixels = u64::from(size.x) * u64::from(size.y);
        let goal = self.until.goal(pixels, started.elapsed().as_secs_f64());
        let meter = Meter::new(&self.description.name, goal, quiet);
        engine.on_compiling(watch_compiling(meter.show_compiling()));
        let bands = Bands::of(film.window(), self.gpu.most_bytes());
        if self.arguments.robust && self.description.render.adaptive == Adaptive::On {
            output::note("--robust is left out: samples of adaptive films are not summed in blocks");
        }
        if (self.arguments.robust || self.arguments.sources) && bands.are_several() {
            output::note(
                "--robust and --sources are left out: they need a film that the device holds whole, so render a smaller --size or a --crop",
            );
            engine.set_robust(false);
        }
        let tracing = Tracing::new(engine, meter, (self.until, quiet), interrupt);
        tracing.trace(&film, bands, &mut |part| self.take(part))
    }

    /// Writes a band below the last one; false where there is no file left to write.
    fn take(&mut self, part: FilmPart) -> bool {
        if self.strips.is_none() {
            let film = self.description.film;
            let frame = Frame { size: film.size, window: film.window() };
            self.strips = Some(self.outputs.begin(frame, self.most_metadata()));
        }
        let Some(strips) = &mut self.strips else { return false };
        strips.add(Rows { linear: part.rgb, display: part.picture });
        !self.has_no_files()
    }

    /// Whether nothing of what is traced can be kept any more.
    fn has_no_files(&self) -> bool {
        self.strips.as_ref().is_some_and(Strips::have_all_failed) && self.outputs.are_pictures()
    }

    /// Bytes that the metadata of a film take as JSON, whatever its samples will be.
    fn most_metadata(&self) -> usize {
        let described = Described {
            path: self.path,
            description: self.description,
            defines: &self.arguments.flags.define,
            shaders: self.arguments.flags.shaders.as_deref(),
            window: self.description.film.window(),
            spp: u32::MAX,
            adapter: &self.gpu.name(),
        };
        // It is repeated by the number of its samples, or by what it was rendered for.
        let flags: usize = self.until.flags().iter().map(|(name, value)| name.len() + value.len() + 2).sum();
        let metadata = described.metadata();
        let texts = metadata.iter().map(|(key, value)| serde_json::json!({ *key: value }).to_string().len());
        texts.sum::<usize>() + flags
    }
}

/// Writes the files, then says so; whether all were written. `whole` are the pixels of a film that was traced at once; those of another are
/// in `strips`.
fn save_and_report(
    summary: &RenderSummary,
    whole: Option<&FilmPart>,
    strips: Option<Strips>,
    outputs: &mut Outputs,
) -> Result<bool, Failure> {
    let metadata = summary.metadata();
    let failures = match (whole, strips) {
        (Some(film), _) => {
            let picture = Picture {
                size: film.size,
                window: film.window,
                linear: &film.rgb,
                display: &film.picture,
                metadata: &metadata,
                report: &serde_json::Value::Null,
            };
            outputs.write(&picture, |written| summary.json(written))
        }
        (None, strips) => outputs.finish(strips.unwrap_or_default(), &metadata, |written| summary.json(written)),
    };
    let written = output::all_written(failures);
    let arguments = summary.arguments;
    if !arguments.quiet {
        summary.bad_lines().iter().chain(summary.full_line().as_ref()).for_each(|line| output::note(line));
        summary.interrupted_lines(outputs).iter().for_each(|line| output::note(line));
    }
    match arguments.json {
        true => output::print(&format!("{}\n", summary.json(outputs)))?,
        false => output::print(&summary.text(outputs, arguments.stats))?,
    }
    Ok(written)
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
