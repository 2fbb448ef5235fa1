//! `bench [SCENE]...`: how the error of a film falls with its samples and its time, by integrator, sampler and roulette.
//!
//! Every configuration renders films of independent seeds. Their relMSE is taken against a reference of many more
//! samples, whose own error is known and subtracted: E (I - R)^2 = var I + var R.

pub mod against;
mod arguments;
pub mod configuration;
pub mod files;
pub mod key;
pub mod measure;
pub mod plot;
mod read;
pub mod record;
pub mod reference;
pub mod scene;
pub mod tables;
pub mod winner;

use std::sync::Arc;

pub use arguments::LightArguments;

use super::BenchError;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::key::scene_key;
use crate::app::shared::output;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::app::{Exit, Failure};
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::Library;
use arguments::ReferenceBy;
use record::{Bench, SceneRecord};
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
    files::prepare(&arguments.out, &FILES)?;
    let library = Library::shipped();
    let mut subjects = Vec::new();
    for name in arguments.scenes()? {
        subjects.push(subject(&name, arguments, &library)?);
    }
    let gpu = Gpu::open()?;
    let mut bench = Bench::new(&gpu, arguments.seeds, arguments.spp);
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
    let path = crate::scene::find(name)?;
    let description = scene::read(&path, (arguments.size, arguments.max_depth), library, arguments.quiet)?;
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
    let (names, whole) = files::write(&arguments.out, &FILES, &[&json, &tables::csv(bench), &table], bench);
    output::print(&if arguments.json { json } else { format!("{table}\n{names}\n{}", winner::sentences(bench)) })?;
    if let Some(verdict) = verdict.as_ref().filter(|_| arguments.json && !arguments.quiet) {
        output::note(&verdict.markdown());
    }
    let passed = verdict.is_none_or(|verdict| verdict.passed());
    Ok(if passed && whole { Exit::Done } else { Exit::Failed })
}
