//! After new surface code has shown its first pixels, a thread asks it whether sampling and evaluation agree. Nothing waits for it.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::event::{Problem, ReloadEvent};
use super::lint::{self, Finding, Surfaces, VIEWS};
use crate::gpu::{Gpu, Runtime, Values};
use crate::layout::trace::MaterialRecord;
use crate::passes::lint::LINT;
use crate::passes::trace::Needs;
use crate::shader::Library;

/// The random numbers of every lint are the same: one and the same code is never called right and then wrong.
const SEED: u32 = 0x1e57;

/// Wakes the driver.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// What lints the engine's code.
pub struct Linter {
    /// The code that was found to be as it is, or that the engine began with.
    judged: Option<Library>,
    /// The code on the device may be other than `judged`.
    stale: bool,
    /// Number of the code on the device: a lint of an earlier one is dropped.
    serial: Arc<AtomicU64>,
    results: Mutex<Receiver<Verdict>>,
    sender: Sender<Verdict>,
    thread: Option<JoinHandle<()>>,
    wake: Wake,
}

/// What a lint found.
struct Verdict {
    serial: u64,
    library: Library,
    /// None where the code of the surfaces is what was judged before.
    told: Option<(Vec<Problem>, Duration)>,
}

impl Linter {
    /// `judged` is the code that runs now.
    pub fn new(judged: Option<Library>, wake: Wake) -> Self {
        let (sender, results) = channel();
        let results = Mutex::new(results);
        Self { judged, stale: false, serial: Arc::default(), results, sender, thread: None, wake }
    }

    /// Other code was put in place: what is being found out of the last is no longer of use.
    pub fn forget(&mut self) {
        self.serial.fetch_add(1, Ordering::Relaxed);
        self.stale = true;
    }

    /// Looks at the code that runs now, if it was not yet looked at, on the surfaces of the scene. `reused`: its paths are.
    pub fn start(&mut self, runtime: &Runtime, materials: Vec<(String, MaterialRecord)>, reused: bool) {
        let Some(judged) = self.judged.clone().filter(|_| std::mem::take(&mut self.stale)) else { return };
        let serial = self.serial.load(Ordering::Relaxed);
        let (gpu, library, current) = (runtime.gpu().clone(), runtime.library().clone(), self.serial.clone());
        let values = runtime.values().clone();
        let (sender, wake, last) = (self.sender.clone(), self.wake.clone(), self.thread.take());
        self.thread = Some(std::thread::spawn(move || {
            // It ends soon: it is of no use any more.
            if let Some(last) = last {
                let _ = last.join();
            }
            let wanted = || current.load(Ordering::Relaxed) == serial;
            let surfaces = Surfaces { materials: &materials, reused };
            if let Some(told) = lint_edit(&gpu, [&judged, &library], &values, surfaces, wanted)
                && sender.send(Verdict { serial, library, told }).is_ok()
            {
                wake();
            }
        }));
    }

    /// What was found since the last call of the code that runs now.
    pub fn take(&mut self) -> Vec<ReloadEvent> {
        let current = self.serial.load(Ordering::Relaxed);
        let results: Vec<Verdict> = self.results.get_mut().unwrap_or_else(PoisonError::into_inner).try_iter().collect();
        let mut events = Vec::new();
        for verdict in results.into_iter().filter(|verdict| verdict.serial == current) {
            self.judged = Some(verdict.library);
            if let Some((warnings, took)) = verdict.told {
                events.push(ReloadEvent::Linted { warnings, took });
            }
        }
        events
    }
}

impl Drop for Linter {
    fn drop(&mut self) {
        self.forget();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Asks the surfaces of a library whether sampling and evaluation agree: what it found, and how long it took.
///
/// `None` where nothing can be said: the code does not link, does not run, or nobody wants to know any more. `Some(None)` where it is the
/// code of `judged`, which is known already.
pub fn lint_edit(
    gpu: &Arc<Gpu>,
    [judged, library]: [&Library; 2],
    values: &Values,
    surfaces: Surfaces,
    wanted: impl Fn() -> bool,
) -> Option<Option<(Vec<Problem>, Duration)>> {
    let begin = Instant::now();
    let records: Vec<MaterialRecord> = surfaces.materials.iter().map(|(_, record)| *record).collect();
    let needs = Needs { materials: &records, reuse: surfaces.reused, ..Needs::default() };
    let features = needs.features().into_iter().map(str::to_owned).collect();
    let new = library.link(LINT.module, &features).ok()?;
    if judged.link(LINT.module, &features).is_ok_and(|old| old.is_same(&new)) {
        return Some(None);
    }
    let edited = new.imports.iter().find(|module| judged.hash(module) != library.hash(module));
    let findings = lint::run(gpu, library.clone(), surfaces, &VIEWS, (SEED, values), wanted).ok()??;
    let file = edited.map(|module| format!("{module}.wgsl"));
    let warnings = findings.into_iter().map(|finding| problem(file.clone(), &finding)).collect();
    Some(Some((warnings, begin.elapsed())))
}

/// A finding as it is told.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{text}")]
#[diagnostic(severity(Warning), help("shaders/README.md says what sampling and evaluation owe each other"))]
struct Warned {
    text: String,
}

fn problem(file: Option<String>, finding: &Finding) -> Problem {
    let message = finding.to_string();
    let text = file.iter().map(|file| format!("{file}: ")).collect::<String>() + &message;
    Problem { file, line: 0, column: 0, message, diagnostic: Arc::new(Warned { text }) }
}
