//! `bench [SCENE]...`: how the error of a film falls with its samples and its time, by integrator, sampler and roulette.
//!
//! Every configuration renders films of independent seeds. Their relMSE is taken against a reference of many more
//! samples, whose own error is known and subtracted: E (I - R)^2 = var I + var R.

pub mod against;
mod arguments;
pub mod configuration;
pub mod key;
pub mod measure;
pub mod plot;
mod read;
pub mod record;
pub mod reference;
pub mod tables;
pub mod winner;

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

pub use arguments::LightArguments;

use super::BenchError;
use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::key::scene_key;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::app::{Exit, Failure};
use crate::gpu::Gpu;
use crate::image::file;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;
use arguments::ReferenceBy;
use record::{Bench, Machine, SceneRecord};
use reference::{Reference, Shelf};

/// The files that are written, beside the plots.
const FILES: [&str; 3] = ["bench.json", "bench.csv", "bench.md"];

/// A scene to be measured.
struct Subject {
    description: SceneDescription,
    shelf: Shelf,
    /// If it was made before.
    reference: Option<Reference>,
}

/// Measures, writes all files, and compares with an earlier benchmark if that is wanted.
pub fn run(arguments: &LightArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let earlier = arguments.against.as_deref().map(against::read).transpose()?;
    // What is measured for an hour is not to end in a refusal.
    for name in FILES {
        file::prepare(&arguments.out.join(name)).map_err(BenchError::from)?;
    }
    let library = Library::shipped();
    let mut subjects = Vec::new();
    for name in arguments.scenes()? {
        subjects.push(subject(&name, arguments, &library)?);
    }
    let gpu = Gpu::open()?;
    let mut bench = empty(&gpu, arguments);
    let goal = Goal { samples: Some(samples(&subjects, arguments)), seconds: None, error: None };
    let mut monitor = Monitor { meter: Meter::new("bench", goal, arguments.quiet), interrupt };
    let mut fault = None;
    for subject in subjects {
        if let Err(error) = measure_scene(&gpu, &library, subject, arguments, &mut monitor, &mut bench) {
            fault = Some(error);
            break;
        }
    }
    monitor.meter.finish();
    monitor.interrupt.hold();
    bench.interrupted = monitor.interrupt.requested() || fault.is_some();
    let told = tell(&bench, arguments, earlier.as_ref())?;
    match (fault, monitor.interrupt.requested()) {
        (Some(error), _) => Err(error.into()),
        (None, true) => Ok(Exit::Interrupted),
        (None, false) => Ok(told),
    }
}

/// Reads a scene, and finds its reference.
fn subject(name: &str, arguments: &LightArguments, library: &Library) -> Result<Subject, Failure> {
    let loaded = scene::load(&scene::find(name)?, &[])?;
    if !arguments.quiet {
        loaded.warnings.iter().for_each(|warning| show(warning));
    }
    let mut description = loaded.description;
    parameters::check(&description.shader, &loaded.shader_places, library)?;
    if let Some(size) = arguments.size {
        description.film.size = size;
        // A crop in pixels is one of the scene's own size.
        description.film.crop = None;
    }
    description.render.max_depth = arguments.max_depth.unwrap_or(description.render.max_depth);
    let key = key::reference_key(&description, library)?;
    let key = if arguments.reference == ReferenceBy::Cpu { format!("cpu-{key}") } else { key };
    let shelf = Shelf::new(&arguments.out, &description.name, key);
    let spp = arguments.reference_spp();
    let reference = match (shelf.find(&description.film, spp), arguments.reference) {
        (None, ReferenceBy::Cpu) => Some(shelf.make_on_processor(&description, spp, arguments.quiet)?),
        (found, _) => found,
    };
    Ok(Subject { description, shelf, reference })
}

fn empty(gpu: &Gpu, arguments: &LightArguments) -> Bench {
    Bench {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        made: now(),
        interrupted: false,
        machine: machine(gpu),
        seeds: arguments.seeds,
        spp: arguments.spp,
        scenes: Vec::new(),
    }
}

/// Seconds since 1970.
pub fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}

/// What this runs on.
pub fn machine(gpu: &Gpu) -> Machine {
    Machine {
        adapter: gpu.name(),
        software: gpu.is_software(),
        os: std::env::consts::OS.to_owned(),
        architecture: std::env::consts::ARCH.to_owned(),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
    }
}

/// All samples of all films, references that are missing included.
fn samples(subjects: &[Subject], arguments: &LightArguments) -> u64 {
    let one = |subject: &Subject| {
        let size = subject.description.film.window().size();
        let reference = if subject.reference.is_some() { 0 } else { arguments.reference_spp() };
        let films = arguments.extent().samples() * arguments.configs.len() as u64;
        (u64::from(size.x) * u64::from(size.y)).saturating_mul(films + u64::from(reference))
    };
    subjects.iter().map(one).fold(0, u64::saturating_add)
}

/// Measures every configuration of a scene. What was measured before a signal or an error is kept.
fn measure_scene(
    gpu: &Arc<Gpu>,
    library: &Library,
    subject: Subject,
    arguments: &LightArguments,
    monitor: &mut Monitor,
    bench: &mut Bench,
) -> Result<(), BenchError> {
    let Subject { description, shelf, reference } = subject;
    if monitor.interrupt.requested() {
        return Ok(());
    }
    let mut tracer = Tracer::open(gpu, library, &description)?;
    tracer.show_compiling(&monitor.meter);
    let reference = match reference {
        Some(reference) => reference,
        None => {
            monitor.meter.rename(&format!("{}, reference", description.name));
            let made = shelf.make(&mut tracer, &description.film, arguments.reference_spp(), monitor)?;
            let Some(reference) = made else { return Ok(()) };
            reference
        }
    };
    let at = bench.scenes.len();
    bench.scenes.push(SceneRecord {
        scene: description.name.clone(),
        size: description.film.window().size().to_array(),
        max_depth: description.render.max_depth,
        triangles: 0,
        key: scene_key(&description),
        reference: reference.record.clone(),
        configurations: Vec::new(),
    });
    for configuration in &arguments.configs {
        monitor.meter.rename(&format!("{}, {configuration}", description.name));
        let measured = measure::measure(&mut tracer, *configuration, arguments.extent(), &reference, monitor)?;
        if let Some(measured) = measured {
            bench.scenes[at].configurations.push(measured);
            monitor.interrupt.hold();
        }
    }
    bench.scenes[at].triangles = tracer.report()?.triangles;
    Ok(())
}

/// Writes all files and says what they hold.
fn tell(bench: &Bench, arguments: &LightArguments, earlier: Option<&Bench>) -> Result<Exit, Failure> {
    let measured = bench.scenes.iter().any(|scene| !scene.configurations.is_empty());
    if !measured {
        output::note("nothing was measured: nothing was written");
        return Ok(Exit::Failed);
    }
    let verdict = earlier.map(|earlier| against::compare(bench, earlier, arguments.tolerance / 100.0));
    let json = serde_json::to_string_pretty(bench).map_err(BenchError::from)? + "\n";
    let mut table = tables::markdown(bench);
    if let Some(verdict) = &verdict {
        table += &format!("\n{}", verdict.markdown());
    }
    let mut files: Vec<(String, String)> =
        FILES.map(str::to_owned).into_iter().zip([json.clone(), tables::csv(bench), table.clone()]).collect();
    for scene in &bench.scenes {
        for axis in [plot::Axis::Seconds, plot::Axis::Samples] {
            files.extend(plot::svg(bench, scene, axis).map(|svg| (plot::file_name(scene, axis), svg)));
        }
    }
    let (mut names, mut whole) = (String::new(), true);
    for (name, text) in &files {
        let path = arguments.out.join(name);
        match file::write_text(&path, text) {
            Ok(()) => names += &format!("{}\n", path.display()),
            Err(failure) => {
                show(&failure);
                whole = false;
            }
        }
    }
    output::print(&if arguments.json { json } else { format!("{table}\n{names}\n{}", winner::sentences(bench)) })?;
    if let Some(verdict) = verdict.as_ref().filter(|_| arguments.json && !arguments.quiet) {
        output::note(&verdict.markdown());
    }
    let passed = verdict.is_none_or(|verdict| verdict.passed());
    Ok(if passed && whole { Exit::Done } else { Exit::Failed })
}
