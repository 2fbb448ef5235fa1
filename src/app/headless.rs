//! `lucerna render`: drives the schedule until the film is finished, and saves it.

use std::path::Path;
use std::time::{Duration, Instant};

use super::arguments::{RenderArguments, Switch};
use super::failure::show;
use super::interrupt::Interrupt;
use super::progress::{Goal, Meter};
use super::report::{Account, Seconds};
use super::{Exit, Failure, output};
use crate::gpu::Gpu;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;
use crate::systems::Engine;
use crate::systems::save::{Output, Picture, SaveError};

/// Tracing between two looks at the clock and at signals.
const STEP: Duration = Duration::from_millis(100);

/// How tracing ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ended {
    Finished,
    Interrupted,
}

/// Loads, renders, saves and reports. `started` is when the process began.
pub fn render(arguments: &RenderArguments, started: Instant) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen();
    let begin = Instant::now();
    let path = scene::find(&arguments.scene)?;
    let loaded = scene::load(&path, &arguments.define)?;
    if !arguments.quiet {
        loaded.warnings.iter().for_each(|warning| show(warning));
    }
    let mut description = loaded.description;
    adjust(&mut description, arguments)?;
    let outputs = outputs(arguments, &path)?;
    for output in &outputs {
        output.prepare()?;
    }
    let load = begin.elapsed();

    let begin = Instant::now();
    let gpu = Gpu::open()?;
    let start = begin.elapsed();
    let begin = Instant::now();
    let mut engine = Engine::open(gpu, Library::shipped(), &description).map_err(Failure::engine)?;
    engine.set_timing(true);
    let load = load + begin.elapsed();

    let ended = trace(&mut engine, &description, arguments, &interrupt)?;
    let film = engine.film().map_err(Failure::engine)?;
    let report = engine.report().map_err(Failure::engine)?;
    if report.samples == 0 {
        output::note("interrupted before the first sample: nothing was written");
        return Ok(Exit::Interrupted);
    }
    let seconds =
        Seconds { start: start.as_secs_f64(), load: load.as_secs_f64(), total: started.elapsed().as_secs_f64() };
    let interrupted = ended == Ended::Interrupted;
    let account = Account {
        arguments,
        path: &path,
        description: &description,
        film: &film,
        report: &report,
        seconds,
        interrupted,
    };
    save_and_tell(&account, &outputs)?;
    Ok(if interrupted { Exit::Interrupted } else { Exit::Done })
}

/// Writes the files, then says so.
fn save_and_tell(account: &Account, outputs: &[Output]) -> Result<(), Failure> {
    let names: Vec<String> = outputs.iter().map(|output| output.path.display().to_string()).collect();
    let (metadata, json) = (account.metadata(), account.json(&names));
    let picture = Picture {
        size: account.film.size,
        window: account.film.window,
        linear: &account.film.rgb,
        display: &account.film.picture,
        metadata: &metadata,
        report: &json,
    };
    for output in outputs {
        output.write(&picture)?;
    }
    let arguments = account.arguments;
    if account.report.bad_samples > 0 && !arguments.quiet {
        output::note(&format!(
            "warning: {} samples were no numbers, or too large, and were left out; --json lists the first",
            account.report.bad_samples
        ));
    }
    if account.interrupted && !arguments.quiet {
        output::note(&format!("interrupted at {} of {} spp", account.film.spp, account.description.render.spp));
    }
    match arguments.json {
        true => output::print(&format!("{json}\n")),
        false => output::print(&account.text(&names, arguments.stats)),
    }
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
    let by_samples = arguments.time.is_none() || arguments.spp.is_some();
    let goal = Goal {
        samples: by_samples.then(|| pixels.saturating_mul(u64::from(description.render.spp))),
        seconds: arguments.time,
    };
    let mut meter = Meter::new(&description.name, goal, arguments.quiet);
    loop {
        let left = arguments.time.map_or(STEP, |time| Duration::from_secs_f64(time).saturating_sub(meter.elapsed()));
        let step = engine.step(STEP.min(left)).map_err(Failure::engine)?;
        meter.advance(step.samples, step.spp);
        let ended = match (step.finished, interrupt.asked()) {
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

/// Makes a camera the active one.
pub(super) fn choose_camera(description: &mut SceneDescription, name: &str) -> Result<(), Failure> {
    if !description.cameras.contains_key(name) {
        let names: Vec<&str> = description.cameras.keys().map(String::as_str).collect();
        let help = format!("its cameras are: {}", names.join(", "));
        return Err(Failure::usage(format!("--camera: the scene has no camera `{name}`"), help));
    }
    description.active = name.to_owned();
    Ok(())
}

/// Applies the flags to the scene, over what its file and the defines say.
fn adjust(description: &mut SceneDescription, arguments: &RenderArguments) -> Result<(), Failure> {
    if let Some(name) = &arguments.camera {
        choose_camera(description, name)?;
    }
    let (film, render) = (&mut description.film, &mut description.render);
    film.size = arguments.size.unwrap_or(film.size);
    film.crop = arguments.crop.or(film.crop);
    film.exposure = arguments.exposure.unwrap_or(film.exposure);
    if let Some(crop) = film.crop
        && crop.max.cmpgt(film.size).any()
    {
        let [x0, x1, y0, y1] = [crop.min.x, crop.max.x, crop.min.y, crop.max.y];
        let (message, help) = match arguments.crop {
            Some(_) => ("--crop", "choose a part of the picture, or a larger --size"),
            None => ("the scene's crop", "give a --crop that fits the --size"),
        };
        let message =
            format!("{message} {x0},{x1},{y0},{y1} reaches beyond the picture of {}x{}", film.size.x, film.size.y);
        return Err(Failure::usage(message, help));
    }
    // With a time alone, the scene's own number of samples is no limit.
    let unlimited = arguments.time.map_or(render.spp, |_| u32::MAX);
    render.spp = arguments.spp.unwrap_or(unlimited);
    render.seed = arguments.seed.unwrap_or(render.seed);
    render.integrator = arguments.integrator.map_or(render.integrator, Into::into);
    render.sampler = arguments.sampler.map_or(render.sampler, Into::into);
    render.max_depth = arguments.max_depth.unwrap_or(render.max_depth);
    render.roulette = arguments.roulette.map_or(render.roulette, |switch| switch == Switch::On);
    Ok(())
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
