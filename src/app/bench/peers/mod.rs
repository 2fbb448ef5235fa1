//! `bench peers [SCENE]...`: Lucerna and Mitsuba 3 on the same scenes, side by side: seconds of rendering to each error.
//!
//! Mitsuba reads what `lucerna export` writes. Both are held to one picture, the mean of a long one of each; where those two
//! don't agree within their noise, the scene is not the same in both, and there is no verdict.

mod arguments;
mod contest;
mod error;
mod peer;
pub mod python;
mod race;
pub mod references;
pub mod verdict;

pub use arguments::PeersArguments;
pub use error::PeerError;
pub use peer::Answer;

use super::BenchError;
use super::light::record::Bench;
use super::light::{self, files, tables};
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::tracer::Monitor;
use crate::app::{Exit, Failure};
use crate::components::TextureFilter;
use crate::gpu::Gpu;
use crate::scene;
use crate::shader::Library;
use arguments::Variant;
use contest::{Rig, Subject, meter};
use verdict::Verdict;

/// The files that are written, beside the plots.
const FILES: [&str; 2] = ["peers.json", "peers.md"];

/// Measures, writes all files, and says who was sooner.
pub fn run(arguments: &PeersArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    files::prepare(&arguments.out, &FILES)?;
    let python = python::find(arguments.peer.as_deref()).map_err(Failure::of)?;
    let library = Library::shipped();
    let subjects: Vec<Subject> =
        arguments.scenes.iter().map(|name| subject(name, arguments, &library)).collect::<Result<_, _>>()?;
    let gpu = Gpu::open()?;
    let variant = arguments.variant.unwrap_or(if gpu.is_software() { Variant::Llvm } else { Variant::Cuda }).name();
    let folder = tempfile::tempdir().map_err(|source| BenchError::file(&std::env::temp_dir(), source))?;
    let mut bench = Bench::new(&gpu, arguments.runs, 0);
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

/// Reads a scene.
fn subject(name: &str, arguments: &PeersArguments, library: &Library) -> Result<Subject, Failure> {
    let path = scene::find(name)?;
    let own = (arguments.size, arguments.max_depth);
    let mut description = light::scene::read(&path, own, library, arguments.quiet)?;
    // Mitsuba knows lookups at points alone.
    description.render.texture_filter = TextureFilter::Exact;
    Ok(Subject { description, audit: scene::audit(&path) })
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
    let (names, whole) = files::write(&arguments.out, &FILES, &[&json, &table], bench);
    output::print(&if arguments.json { json } else { format!("{short}\n{names}") })?;
    Ok(whole)
}
