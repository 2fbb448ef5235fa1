//! `bench peers [SCENE]...`: Lucerna and Mitsuba 3 on the same scenes, side by side: seconds of rendering to each error.
//!
//! Mitsuba reads what `lucerna export` writes. Both are held to one picture, the mean of a long one of each; where those two
//! don't agree within their noise, the scene is not the same in both, and there is no verdict.

mod arguments;
mod error;
mod peer;
pub mod python;
mod race;
pub mod references;
pub mod verdict;

use std::path::Path;
use std::sync::Arc;

pub use arguments::PeersArguments;
pub use error::PeerError;
pub use peer::Answer;

use super::BenchError;
use super::light::record::{Bench, ReferenceRecord, SceneRecord};
use super::light::{key, machine, plot, tables};
use crate::app::export::mitsuba;
use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::key::scene_key;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::app::{Exit, Failure};
use crate::components::Render;
use crate::gpu::Gpu;
use crate::image::file;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;
use arguments::Variant;
use peer::Peer;
use python::Python;
use race::Race;
use verdict::Verdict;

/// The files that are written, beside the plots.
const FILES: [&str; 2] = ["peers.json", "peers.md"];

/// Samples a pixel of the film that says how many a reference needs.
const PILOT: u32 = 16;

/// By how much a reference's error is to be below the least that is measured.
const QUIETER: f64 = 16.0;

/// A scene, and where it is from.
struct Subject {
    description: SceneDescription,
    audit: scene::Audit,
}

/// What all scenes have in common.
struct Rig<'a> {
    arguments: &'a PeersArguments,
    gpu: Arc<Gpu>,
    library: Library,
    python: Python,
    variant: Variant,
    /// Of what Mitsuba writes.
    folder: tempfile::TempDir,
}

/// Measures, writes all files, and says who was sooner.
pub fn run(arguments: &PeersArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    for name in FILES {
        file::prepare(&arguments.out.join(name))?;
    }
    let python = python::find(arguments.peer.as_deref()).map_err(Failure::of)?;
    let library = Library::shipped();
    let subjects: Vec<Subject> =
        arguments.scenes.iter().map(|name| subject(name, arguments, &library)).collect::<Result<_, _>>()?;
    let gpu = Gpu::open()?;
    let variant = arguments.variant.unwrap_or(if gpu.is_software() { Variant::Llvm } else { Variant::Cuda });
    let folder = tempfile::tempdir().map_err(|source| BenchError::file(&std::env::temp_dir(), source))?;
    let mut bench = Bench {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        made: super::light::now(),
        interrupted: false,
        machine: machine(&gpu),
        seeds: arguments.runs,
        spp: 0,
        scenes: Vec::new(),
    };
    let rig = Rig { arguments, gpu, library, python, variant, folder };
    let mut monitor = Monitor { meter: meter("peers", None, arguments.quiet), interrupt };
    let (mut verdicts, mut fault) = (Vec::new(), None);
    for subject in &subjects {
        match rig.measure(subject, &mut monitor, &mut bench) {
            Ok(Some(verdict)) => verdicts.push(verdict),
            Ok(None) => break,
            Err(error) => {
                fault = Some(error);
                break;
            }
        }
        monitor.interrupt.hold();
    }
    monitor.meter.finish();
    bench.interrupted = monitor.interrupt.requested() || fault.is_some();
    let whole = tell(&bench, &verdicts, arguments)?;
    match (fault, monitor.interrupt.requested()) {
        (Some(error), _) => Err(error),
        (None, true) => Ok(Exit::Interrupted),
        (None, false) => {
            Ok(if whole && verdicts.iter().all(|v| v.agreement.agree) { Exit::Done } else { Exit::Failed })
        }
    }
}

fn meter(name: &str, samples: Option<u64>, quiet: bool) -> Meter {
    Meter::new(name, Goal { samples, seconds: None, error: None }, quiet)
}

/// Reads a scene.
fn subject(name: &str, arguments: &PeersArguments, library: &Library) -> Result<Subject, Failure> {
    let path = scene::find(name)?;
    let loaded = scene::load(&path, &[])?;
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
    // Mitsuba knows lookups at points alone.
    description.render.texture_filter = crate::components::TextureFilter::Exact;
    Ok(Subject { description, audit: scene::audit(&path) })
}

impl Rig<'_> {
    /// Measures a scene. None if a signal came before there was anything to say.
    fn measure(&self, subject: &Subject, monitor: &mut Monitor, bench: &mut Bench) -> Result<Option<Verdict>, Failure> {
        let (arguments, description) = (self.arguments, &subject.description);
        let (quiet, name) = (arguments.quiet, &description.name);
        let exported = mitsuba::export(description, subject.audit.clone(), &arguments.out.join("scenes").join(name))?;
        let size = description.film.window().size();
        let pixels = u64::from(size.x) * u64::from(size.y);
        let scene_file = std::path::absolute(&exported.scene).map_err(|e| BenchError::file(&exported.scene, e))?;
        let (variant, folder) = (self.variant.name(), self.folder.path());
        let started = Peer::start(&self.python, variant, (&scene_file, size), folder, (&monitor.interrupt, quiet))?;
        let Some(mut peer) = started else { return Ok(None) };
        let peer_name = format!("mitsuba {}, {variant}", self.python.version);

        let mut tracer = Tracer::open(&self.gpu, &self.library, description).map_err(Failure::engine)?;
        tracer.show_compiling(&monitor.meter);
        let Some(spp) = self.reference_spp(&mut tracer, monitor)? else { return Ok(None) };
        monitor.meter = meter(&format!("{name}, references"), Some(2 * pixels * u64::from(spp)), quiet);
        let Some(ours) = references::of_lucerna(&mut tracer, spp, monitor)? else { return Ok(None) };
        let Some(theirs) = references::of_peer(&mut peer, spp, (monitor, pixels))? else { return Ok(None) };
        let mut verdict = Verdict {
            scene: name.clone(),
            peer: peer_name.clone(),
            agreement: references::agreement(&ours, &theirs, arguments.to),
            notes: exported.notes.iter().map(ToString::to_string).collect(),
            beside: Vec::new(),
        };
        if !verdict.agreement.agree {
            return Ok(Some(verdict));
        }
        let record = ReferenceRecord {
            key: key::reference_key(description, &self.library)?,
            by: format!("{} and {peer_name}", references::BY),
            seed: 0,
            spp,
            relmse: 0.0,
            adapter: self.gpu.name(),
            seconds: 0.0,
        };
        let reference = references::together(&ours, &theirs, &verdict.agreement, record);
        monitor.meter = meter(&format!("{name}, first pictures"), None, quiet);
        let mut race = Race { tracer: &mut tracer, peer: &mut peer, reference: &reference, monitor, pixels };
        let mut all = Vec::new();
        for configuration in &arguments.configs {
            let Some(numbers) = race.try_out(*configuration, arguments.to)? else { return Ok(None) };
            all.push((*configuration, numbers));
        }
        let Some(numbers) = race.try_out_peer(arguments.to)? else { return Ok(None) };
        let films: u64 = all.iter().map(|(_, numbers)| u64::from(numbers[numbers.len() - 1])).sum();
        let pictures: u64 = numbers.iter().map(|spp| u64::from(*spp)).sum();
        race.monitor.meter = meter(name, Some(pixels * u64::from(arguments.runs) * (films + pictures)), quiet);
        let measured = race.run(&all, (&peer_name, &numbers), arguments.runs)?;
        let Some((theirs, ours)) = measured.split_last() else { return Ok(None) };
        verdict.beside = ours.iter().map(|ours| verdict::beside(ours, theirs, arguments.to)).collect();
        let triangles = tracer.report().map_err(Failure::engine)?.triangles;
        bench.spp = bench.spp.max(numbers[numbers.len() - 1]);
        bench.scenes.push(SceneRecord {
            scene: name.clone(),
            size: size.to_array(),
            max_depth: description.render.max_depth,
            triangles,
            key: scene_key(description),
            reference: reference.record,
            configurations: measured,
        });
        Ok(Some(verdict))
    }

    /// Samples a pixel that a reference needs, by what a small film says of its own error. None if a signal came.
    fn reference_spp(&self, tracer: &mut Tracer, monitor: &mut Monitor) -> Result<Option<u32>, Failure> {
        if let Some(spp) = self.arguments.reference_spp {
            return Ok(Some(spp));
        }
        tracer.set(Render { spp: PILOT, ..references::BY.of(&tracer.render) });
        if !tracer.finish(monitor).map_err(Failure::engine)? {
            return Ok(None);
        }
        let error = tracer.film().map_err(Failure::engine)?.relative_error;
        let needed = f64::from(PILOT) * error / self.arguments.to * QUIETER;
        Ok(Some((needed.clamp(256.0, f64::from(1u32 << 20)) as u32).next_power_of_two()))
    }
}

/// Writes all files, and says what they hold. False where one could not be written.
fn tell(bench: &Bench, verdicts: &[Verdict], arguments: &PeersArguments) -> Result<bool, Failure> {
    if verdicts.is_empty() {
        output::note("nothing was measured: nothing was written");
        return Ok(true);
    }
    let json = serde_json::json!({ "bench": bench, "verdicts": verdicts });
    let json = serde_json::to_string_pretty(&json).map_err(BenchError::from)? + "\n";
    let short = verdict::markdown(verdicts);
    let table = format!(
        "# Seconds to an error, beside Mitsuba\n\nLucerna on {}; Mitsuba on {} threads of the processor where its variant is not one of CUDA.\n\n{short}\n{}",
        bench.machine.adapter,
        bench.machine.threads,
        tables::markdown(bench)
    );
    let mut files: Vec<(String, String)> = FILES.map(str::to_owned).into_iter().zip([json.clone(), table]).collect();
    for scene in &bench.scenes {
        for axis in [plot::Axis::Seconds, plot::Axis::Samples] {
            files.extend(plot::svg(bench, scene, axis).map(|svg| (plot::file_name(scene, axis), svg)));
        }
    }
    let (mut names, mut whole) = (String::new(), true);
    for (name, text) in &files {
        let path = arguments.out.join(name);
        whole &= written(&path, text);
        names += &format!("{}\n", path.display());
    }
    output::print(&if arguments.json { json } else { format!("{short}\n{names}") })?;
    Ok(whole)
}

fn written(path: &Path, text: &str) -> bool {
    let result = file::write_text(path, text);
    result.as_ref().err().into_iter().for_each(|failure| show(failure));
    result.is_ok()
}
