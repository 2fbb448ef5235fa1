//! From a row of the pass table to a compute pipeline: linked, checked against its row, compiled, kept.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::entry::{checked_entry, features_of};
use super::{Gpu, GpuError};
use crate::passes::table::TABLE;
use crate::passes::{Access, Pass};
use crate::shader::{
    EntryPoint, Features, Library, Linked, LinkedParameter, Parameter, Place, ResourceKind, SHADER_VALUES, ShaderError,
    on_large_stack,
};

/// What parameters of shaders are set to, by their names; those that are not in here have their defaults. A switch is 0 or 1.
pub type Values = BTreeMap<String, f64>;

/// Rounds of all loops of one invocation of an edited shader. The longest paths that a scene may ask for take 2,048;
/// with shadow rays that go on through see-through surfaces, those of a depth up to 722 take less than this.
const ROUNDS: u32 = 1 << 18;

/// The same on drivers that draw on the processor: Mesa's ends every loop after 65,535 rounds and says nothing.
const ROUNDS_IN_SOFTWARE: u32 = 60_000;

/// Loops of one pipeline are numbered within so many.
const LOOPS: u32 = 4096;

/// A compiled pass.
pub struct Pipeline {
    pub(super) compute: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) entry: EntryPoint,
    /// Unlike for every pipeline ever made: what bind groups are cached by.
    pub(super) serial: u32,
    /// Equal for equal code.
    fingerprint: u64,
    /// It is of an edited shader.
    edited: bool,
    /// Its loops end after so many rounds, as those of edited shaders do.
    limited: bool,
}

/// A pass as it is compiled now.
#[derive(Clone)]
pub struct Use {
    pub pass: &'static Pass,
    /// The scene's features when it was last asked for.
    pub features: Features,
    /// Those of them that its import closure names.
    key: Features,
    /// The modules it was linked from.
    imports: BTreeSet<String>,
    /// Where the loops of an edited shader are in its text as it is now, of which the pipeline may be older.
    loops: Vec<Place>,
    /// Those of its modules, as the text declares them now, in the order of their words.
    parameters: Vec<LinkedParameter>,
    pub(super) pipeline: Arc<Pipeline>,
}

impl Use {
    /// The words that its parameters come to.
    fn words(&self, values: &Values) -> Vec<u32> {
        self.parameters.iter().map(|linked| word(linked, values)).collect()
    }

    /// Of those words, the ones that it reads, by name.
    fn read(&self, values: &Values) -> BTreeMap<&str, u32> {
        let read = self.parameters.iter().filter(|linked| linked.is_read);
        read.map(|linked| (linked.parameter.name.as_str(), word(linked, values))).collect()
    }

    /// The place of a loop by the number that the shader gives it.
    pub(super) fn place_of_loop(&self, number: u32) -> Option<&Place> {
        let first = self.pipeline.serial.wrapping_mul(LOOPS);
        self.loops.get(number.checked_sub(first + 1)? as usize)
    }
}

fn word(linked: &LinkedParameter, values: &Values) -> u32 {
    let parameter = &linked.parameter;
    parameter.word(parameter.value(values.get(&parameter.name).copied()))
}

/// Compiles passes on any thread: what pipelines and those who remake them share.
#[derive(Clone)]
pub struct Compiler {
    gpu: Arc<Gpu>,
    serial: Arc<AtomicU32>,
    in_use: Arc<Mutex<BTreeMap<&'static str, Use>>>,
    /// How many pipelines of each pass were compiled.
    compiled: Arc<Mutex<BTreeMap<&'static str, u64>>>,
}

impl Compiler {
    /// Every pass as it was last used, by name.
    pub(super) fn in_use(&self) -> MutexGuard<'_, BTreeMap<&'static str, Use>> {
        self.in_use.lock().unwrap_or_else(PoisonError::into_inner)
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
                    let (pipeline, loops) = self.compile(pass, linked, &own)?;
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
    ) -> Result<(Pipeline, Vec<Place>), GpuError> {
        let serial = self.serial.fetch_add(1, Ordering::Relaxed);
        *self.compiled.lock().unwrap_or_else(PoisonError::into_inner).entry(pass.name).or_default() += 1;
        let fingerprint = linked.fingerprint();
        let (edited, limited) = (linked.edited, linked.limited);
        let loops = match limited {
            true => linked.limit_loops(self.rounds(), serial.wrapping_mul(LOOPS))?,
            false => Vec::new(),
        };
        let entry = checked_entry(pass, &linked, features)?;
        let (compute, layout) = build(&self.gpu, pass, &entry, linked.module)?;
        Ok((Pipeline { compute, layout, entry, serial, fingerprint, edited, limited }, loops))
    }

    /// Rounds that all loops of an invocation of an edited shader may take.
    fn rounds(&self) -> u32 {
        if self.gpu.is_software() { ROUNDS_IN_SOFTWARE } else { ROUNDS }
    }
}

/// Passes as they were compiled, by name and all features of the scenes that asked for them. Where two scenes' features differ in what a
/// pass's import closure does not name, both share its pipeline.
type Kept = HashMap<(&'static str, Features), Use>;

/// The pipelines of a library.
pub struct Pipelines {
    library: Library,
    compiler: Compiler,
    kept: Kept,
    /// All that the library declares; none where that can't be said, which linking does.
    parameters: Arc<[Parameter]>,
    values: Values,
}

/// The code that passes run, with all that was compiled of it: what is put in the place of what was there, and can be put back.
pub struct Code {
    pub(super) library: Library,
    uses: BTreeMap<&'static str, Use>,
    kept: Kept,
}

impl Code {
    /// All parameters that it declares, by name.
    pub fn parameters(&self) -> Arc<[Parameter]> {
        parameters_of(&self.library)
    }

    fn new(library: Library, uses: Vec<Use>) -> Self {
        let kept = uses.iter().map(|used| ((used.pass.name, used.features.clone()), used.clone())).collect();
        Self { library, uses: uses.into_iter().map(|used| (used.pass.name, used)).collect(), kept }
    }
}

impl Pipelines {
    pub fn new(gpu: Arc<Gpu>, library: Library) -> Self {
        let compiler = Compiler { gpu, serial: Arc::default(), in_use: Arc::default(), compiled: Arc::default() };
        let parameters = parameters_of(&library);
        Self { library, compiler, kept: HashMap::new(), parameters, values: Values::new() }
    }

    pub fn library(&self) -> &Library {
        &self.library
    }

    pub fn compiler(&self) -> &Compiler {
        &self.compiler
    }

    /// All parameters that the library declares, by name.
    pub fn parameters(&self) -> &Arc<[Parameter]> {
        &self.parameters
    }

    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Whether any pass in use reads a parameter.
    pub fn is_read(&self, parameter: &str) -> bool {
        self.compiler.in_use().values().any(|used| used.read(&self.values).contains_key(parameter))
    }

    /// Sets parameters from now on. Returns the passes in use that read another value than before.
    pub fn set_values(&mut self, values: Values) -> Vec<&'static Pass> {
        let before = std::mem::replace(&mut self.values, values);
        let in_use = self.compiler.in_use();
        in_use.values().filter(|used| used.read(&before) != used.read(&self.values)).map(|used| used.pass).collect()
    }

    /// The words of the parameters of a pass in use.
    pub fn words(&self, pass: &Pass) -> Vec<u32> {
        self.compiler.in_use().get(pass.name).map(|used| used.words(&self.values)).unwrap_or_default()
    }

    /// The pipeline of `pass` under `features`, compiled if need be.
    pub fn get(&mut self, pass: &'static Pass, features: &Features) -> Result<Arc<Pipeline>, GpuError> {
        if let Some(pipeline) = self.known(pass, features) {
            return Ok(pipeline);
        }
        self.prepare(&[pass], features)?;
        Ok(self.known(pass, features).expect("invariant: it was just made"))
    }

    /// Compiles all that is missing of `passes`, at the same time.
    pub fn prepare(&mut self, passes: &[&'static Pass], features: &Features) -> Result<(), GpuError> {
        let mut missing: Vec<(&'static Pass, Features)> = Vec::new();
        for pass in passes.iter().filter(|pass| self.known(pass, features).is_none()) {
            if let Some(used) = self.kept.get(&(pass.name, features.clone())) {
                self.compiler.in_use().insert(pass.name, used.clone());
            } else if missing.iter().all(|(m, _)| m.name != pass.name) {
                missing.push((pass, features.clone()));
            }
        }
        let kept = &self.kept;
        let known = |pass: &Pass, key: &Features, _: &Linked| {
            let alike = |used: &&Use| used.pass.name == pass.name && used.key == *key;
            kept.values().find(alike).map(|used| used.pipeline.clone())
        };
        let made = self.compiler.make(&self.library, &missing, known, &|_| {})?;
        let mut in_use = self.compiler.in_use();
        for used in made {
            self.kept.insert((used.pass.name, used.features.clone()), used.clone());
            in_use.insert(used.pass.name, used);
        }
        Ok(())
    }

    /// Whether any of `passes` has to be linked, and perhaps compiled, before it can run.
    pub fn lacks(&self, passes: &[&'static Pass], features: &Features) -> bool {
        passes.iter().any(|pass| !self.kept.contains_key(&(pass.name, features.clone())))
    }

    /// Whether all of `passes` are in use with the code that this binary was built with.
    pub fn are_shipped(&self, passes: &[&'static Pass]) -> bool {
        let in_use = self.compiler.in_use();
        passes.iter().all(|pass| in_use.get(pass.name).is_some_and(|used| !used.pipeline.edited))
    }

    /// Whether the loops of any pass in use are limited.
    pub fn is_limited(&self) -> bool {
        self.compiler.in_use().values().any(|used| used.pipeline.limited)
    }

    /// The place of a loop by the number that its shader gives it.
    pub fn place_of_loop(&self, number: u32) -> Option<Place> {
        self.compiler.in_use().values().find_map(|used| used.place_of_loop(number).cloned())
    }

    /// Puts other code in place. Returns what was there, which can be put back, and the passes that run other code now.
    pub fn replace(&mut self, code: Code) -> (Code, Vec<&'static Pass>) {
        let Code { library, uses: fresh, kept } = code;
        // At once, for whoever compiles meanwhile looks at what is in use.
        let old = std::mem::replace(&mut *self.compiler.in_use(), fresh.clone());
        let values = &self.values;
        let same = |name: &str, used: &Use| {
            let alike = |o: &Use| Arc::ptr_eq(&o.pipeline, &used.pipeline) && o.read(values) == used.read(values);
            old.get(name).is_some_and(alike)
        };
        let new = fresh.iter().filter(|(name, used)| !same(name, used)).map(|(_, used)| used.pass);
        // What came into use while the code was compiled is compiled again when it is asked for.
        let gone = old.iter().filter(|(name, _)| !fresh.contains_key(*name)).map(|(_, used)| used.pass);
        let changed = new.chain(gone).collect();
        self.parameters = parameters_of(&library);
        let library = std::mem::replace(&mut self.library, library);
        let kept = std::mem::replace(&mut self.kept, kept);
        (Code { library, uses: old, kept }, changed)
    }

    fn known(&self, pass: &Pass, features: &Features) -> Option<Arc<Pipeline>> {
        let in_use = self.compiler.in_use();
        in_use.get(pass.name).filter(|used| used.features == *features).map(|used| used.pipeline.clone())
    }
}

impl Compiler {
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
        self.compiled.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

fn parameters_of(library: &Library) -> Arc<[Parameter]> {
    library.parameters().unwrap_or_default().into()
}

/// Whether a binding is what a call brings along: the pass's own parameters, or those of shaders.
fn is_params(pass: &Pass, binding: &str) -> bool {
    binding == SHADER_VALUES || pass.bindings.iter().any(|row| row.name == binding && row.access == Access::Params)
}

fn build(
    gpu: &Gpu,
    pass: &'static Pass,
    entry: &EntryPoint,
    module: naga::Module,
) -> Result<(wgpu::ComputePipeline, wgpu::BindGroupLayout), GpuError> {
    let entries: Vec<_> = entry
        .bindings
        .iter()
        .map(|b| wgpu::BindGroupLayoutEntry {
            binding: b.binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: match b.kind {
                    ResourceKind::StorageRead => wgpu::BufferBindingType::Storage { read_only: true },
                    ResourceKind::StorageReadWrite => wgpu::BufferBindingType::Storage { read_only: false },
                },
                has_dynamic_offset: is_params(pass, &b.name),
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    gpu.guarded(&format!("pipeline `{}`", pass.name), || {
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(pass.module),
            source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module)),
        };
        let mut checks = wgpu::ShaderRuntimeChecks::checked();
        checks.force_loop_bounding = false;
        // SAFETY: every loop of the shipped shaders has a bound of its own, and those of edited ones were given one
        // (naga's would cost 11 % and counts to 2^64).
        let module = unsafe { gpu.device.create_shader_module_trusted(descriptor, checks) };
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(pass.name), entries: &entries });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let compute = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(pass.name),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(pass.entry),
            // Every shipped kernel writes its workgroup memory before it reads it.
            compilation_options: wgpu::PipelineCompilationOptions {
                zero_initialize_workgroup_memory: false,
                ..Default::default()
            },
            cache: None,
        });
        (compute, layout)
    })
}
