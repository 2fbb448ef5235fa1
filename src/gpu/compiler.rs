//! From rows of the pass table to pipelines, on any thread: linked, checked against the row, compiled.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::code::{Code, LOOPS, Use};
use super::entry::{checked_entry, features_of};
use super::pipeline::{Pipeline, build};
use super::pipeline_cache::{PipelineCache, Slot};
use super::{Gpu, GpuError};
use crate::passes::Pass;
use crate::passes::table::TABLE;
use crate::shader::{Features, Library, Linked, Place, ShaderError, on_large_stack};

/// Rounds of all loops of one invocation of an edited shader. The longest paths that a scene may ask for take 2,048;
/// with shadow rays that go on through see-through surfaces, those of a depth up to 722 take less than this.
const ROUNDS: u32 = 1 << 18;

/// The same on drivers that draw on the processor: Mesa's ends every loop after 65,535 rounds and says nothing.
const ROUNDS_IN_SOFTWARE: u32 = 60_000;

/// Compiles passes on any thread: what pipelines and those who remake them share.
#[derive(Clone)]
pub struct Compiler {
    gpu: Arc<Gpu>,
    serial: Arc<AtomicU32>,
    in_use: Arc<Mutex<BTreeMap<&'static str, Use>>>,
    /// What compiling each pass took so far.
    compiled: Arc<Mutex<BTreeMap<&'static str, PassCompile>>>,
}

/// What it took to make pipelines of a pass, in all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassCompile {
    pub name: &'static str,
    /// Pipelines that were compiled.
    pub count: u64,
    /// Those of them of which an earlier start had left a file.
    pub kept: u64,
    /// Linking and validating their code, milliseconds.
    pub link_milliseconds: f64,
    /// The driver's compiling, milliseconds.
    pub driver_milliseconds: f64,
}

impl Compiler {
    pub(super) fn new(gpu: Arc<Gpu>) -> Self {
        Self { gpu, serial: Arc::default(), in_use: Arc::default(), compiled: Arc::default() }
    }

    /// Every pass as it was last used, by name.
    pub(super) fn in_use(&self) -> MutexGuard<'_, BTreeMap<&'static str, Use>> {
        self.in_use.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What the passes in use come to with another library; compiles only what is other code. Nothing that runs is touched.
    ///
    /// Where no pass in use imports some module of `edited`, every pass is linked with all features, so that a mistake in it
    /// is told today and not when a scene first needs it. `warn` is given, before it is compiled, what will take long.
    pub fn remake(
        &self,
        library: Library,
        edited: &BTreeSet<String>,
        warn: &(dyn Fn(ShaderError) + Sync),
    ) -> Result<Code, GpuError> {
        let old: BTreeMap<&'static str, Use> = self.in_use().clone();
        let wanted: Vec<_> = old.values().map(|used| (used.pass, used.features.clone())).collect();
        let same = |pass: &Pass, _: &Features, linked: &Linked| {
            let pipeline = &old.get(pass.name)?.pipeline;
            (pipeline.fingerprint == linked.fingerprint()).then(|| pipeline.clone())
        };
        let uses = self.make(&library, &wanted, same, warn)?;
        if edited.iter().any(|module| !uses.iter().any(|used| used.imports.contains(module))) {
            let all = library.features()?;
            for pass in TABLE {
                checked_entry(pass, &library.link(pass.module, &all)?, &all)?;
            }
        }
        Ok(Code::new(library, uses))
    }

    /// How many pipelines of each pass were compiled since the runtime was made.
    pub fn compiled(&self) -> BTreeMap<&'static str, u64> {
        self.compile_times().into_iter().map(|pass| (pass.name, pass.count)).collect()
    }

    /// What compiling each pass took since the runtime was made, by name.
    pub fn compile_times(&self) -> Vec<PassCompile> {
        self.compiled.lock().unwrap_or_else(PoisonError::into_inner).values().cloned().collect()
    }

    /// Links passes and compiles those for which `known` has nothing, each in a thread of its own: drivers compile in
    /// parallel. `known` is asked with a pass, the features its code depends on, and its code; `warn` gets what a driver that
    /// draws on the processor will take long for.
    pub(super) fn make(
        &self,
        library: &Library,
        wanted: &[(&'static Pass, Features)],
        known: impl Fn(&Pass, &Features, &Linked) -> Option<Arc<Pipeline>> + Sync,
        warn: &(dyn Fn(ShaderError) + Sync),
    ) -> Result<Vec<Use>, GpuError> {
        library.parameters()?;
        let make = |pass: &'static Pass, features: &Features| -> Result<Use, GpuError> {
            let start = Instant::now();
            let own = features_of(pass, features);
            let mut linked = library.link(pass.module, &own)?;
            let (key, imports) = (linked.features.clone(), linked.imports.clone());
            let parameters = linked.parameters.clone();
            let (pipeline, loops) = match known(pass, &key, &linked) {
                Some(pipeline) if pipeline.limited => (pipeline, linked.limit_loops(self.rounds(), 0)?),
                Some(pipeline) => (pipeline, Vec::new()),
                None => {
                    if self.gpu.is_software() {
                        linked.large_variables().into_iter().for_each(warn);
                    }
                    let (pipeline, loops) = self.compile(pass, linked, &own, start)?;
                    (Arc::new(pipeline), loops)
                }
            };
            Ok(Use { pass, features: features.clone(), key, imports, loops, parameters, pipeline })
        };
        std::thread::scope(|scope| {
            let make = &make;
            let threads: Vec<_> = wanted
                .iter()
                .map(|(pass, features)| scope.spawn(move || on_large_stack(|| make(pass, features))))
                .collect();
            let join = |made: std::thread::ScopedJoinHandle<'_, _>| {
                made.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            };
            threads.into_iter().map(join).collect()
        })
    }

    fn compile(
        &self,
        pass: &'static Pass,
        mut linked: Linked,
        features: &Features,
        started: Instant,
    ) -> Result<(Pipeline, Vec<Place>), GpuError> {
        let serial = self.serial.fetch_add(1, Ordering::Relaxed);
        let fingerprint = linked.fingerprint();
        let (edited, limited) = (linked.edited, linked.limited);
        let loops = match limited {
            true => linked.limit_loops(self.rounds(), serial.wrapping_mul(LOOPS))?,
            false => Vec::new(),
        };
        let entry = checked_entry(pass, &linked, features)?;
        let linked_at = Instant::now();
        // Edited code changes too often to be worth keeping.
        let cache = self.gpu.pipeline_cache.as_ref().filter(|_| !edited && !limited);
        let slot = cache.and_then(|cache| self.slot(cache, pass, fingerprint));
        let (compute, layout) = build(&self.gpu, pass, &entry, linked.module, slot.as_ref())?;
        let found = slot.as_ref().is_some_and(|slot| slot.found);
        self.note(pass.name, found, linked_at - started, linked_at.elapsed());
        if let Some(slot) = slot {
            slot.keep();
        }
        Ok((Pipeline { compute, layout, entry, serial, fingerprint, edited, limited }, loops))
    }

    /// Where a pipeline is kept. What is there of another device is removed, and costs this start a compile.
    fn slot(&self, cache: &PipelineCache, pass: &Pass, fingerprint: u64) -> Option<Slot> {
        let slot = self.gpu.guarded("kept pipeline", || cache.slot(&self.gpu.device, pass.name, fingerprint));
        slot.inspect_err(|_| cache.remove(pass.name, fingerprint)).ok()
    }

    /// Takes note of a pipeline that was compiled.
    fn note(&self, pass: &'static str, kept: bool, link: Duration, driver: Duration) {
        let mut compiled = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        let times = compiled.entry(pass).or_insert_with(|| PassCompile { name: pass, ..PassCompile::default() });
        times.count += 1;
        times.kept += u64::from(kept);
        times.link_milliseconds += link.as_secs_f64() * 1e3;
        times.driver_milliseconds += driver.as_secs_f64() * 1e3;
    }

    /// Rounds that all loops of an invocation of an edited shader may take.
    fn rounds(&self) -> u32 {
        if self.gpu.is_software() { ROUNDS_IN_SOFTWARE } else { ROUNDS }
    }
}
