//! The pipelines of a library: compiled when a scene first needs them, kept, and exchanged for those of edited code.

use std::collections::HashMap;
use std::sync::Arc;

use super::code::{Code, Kept, Use, Values, parameters_of};
use super::compiler::Compiler;
use super::pipeline::Pipeline;
use super::{Gpu, GpuError};
use crate::passes::Pass;
use crate::shader::{Features, Library, Linked, Parameter, Place, Probe};

/// The pipelines of a library.
pub struct Pipelines {
    library: Library,
    compiler: Compiler,
    kept: Kept,
    /// All that the library declares; none where that can't be said, which linking does.
    parameters: Arc<[Parameter]>,
    /// All names that the library shows numbers by.
    probes: Arc<[Probe]>,
    values: Values,
}

impl Pipelines {
    pub fn new(gpu: Arc<Gpu>, library: Library) -> Self {
        let parameters = parameters_of(&library);
        let probes = library.probes().into();
        Self { library, compiler: Compiler::new(gpu), kept: HashMap::new(), parameters, probes, values: Values::new() }
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

    /// All names that the library shows numbers by, in order: the place of one is its number.
    pub fn probes(&self) -> &Arc<[Probe]> {
        &self.probes
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
        self.probes = library.probes().into();
        let library = std::mem::replace(&mut self.library, library);
        let kept = std::mem::replace(&mut self.kept, kept);
        (Code { library, uses: old, kept }, changed)
    }

    fn known(&self, pass: &Pass, features: &Features) -> Option<Arc<Pipeline>> {
        let in_use = self.compiler.in_use();
        in_use.get(pass.name).filter(|used| used.features == *features).map(|used| used.pipeline.clone())
    }
}
