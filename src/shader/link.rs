//! Joins a module with what it imports into one text, and keeps where each byte came from.

use std::collections::hash_map::DefaultHasher;
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{Hash, Hasher};
use std::ops::Range;
use std::sync::Arc;

use super::error::{ErrorKind, Place, ShaderError, Source};
use super::generated::Generated;
use super::library::Library;
use super::module::{Import, Module, Named};
use super::parameter::Parameter;
use super::probe::Call;
use super::source_map::SourceMap;
use super::stack::on_large_stack;
use super::values::{self, LinkedParameter};
use super::{Features, budget, check, depth, probe, token};

/// A module with all it imports: parsed, valid, and rid of what no entry point uses.
#[derive(Debug)]
pub struct Linked {
    pub module: naga::Module,
    pub info: naga::valid::ModuleInfo,
    /// The WGSL that was parsed: each module whole, with spaces for what is not WGSL or switched off.
    pub text: String,
    /// The names of the modules it was made of, itself included, `gen` not.
    pub imports: BTreeSet<String>,
    /// The enabled features that any condition in it names: two links of a module with equal features have equal text.
    pub features: Features,
    /// The parameters that its modules declare, in the order of their words in [`SHADER_VALUES`](super::SHADER_VALUES).
    pub parameters: Vec<LinkedParameter>,
    /// Some module of it is not the one that this binary was built with.
    pub edited: bool,
    /// Its loops are to be limited.
    pub limited: bool,
    /// The module that was asked for.
    root: Arc<Source>,
    map: SourceMap,
}

impl Linked {
    /// A number for what the text says: comments and white space apart, equal texts have equal numbers.
    pub fn fingerprint(&self) -> u64 {
        let source = Arc::new(Source { file: String::new(), text: self.text.clone() });
        let mut hasher = DefaultHasher::new();
        for token in token::tokenize(&source).unwrap_or_default() {
            source.text[token.range].hash(&mut hasher);
        }
        hasher.finish()
    }

    /// Whether another does the same where no parameter is set: of equal text, and with the defaults of those that are read.
    pub fn is_same(&self, other: &Linked) -> bool {
        let words = |linked: &Linked| -> Vec<u32> {
            let read = linked.parameters.iter().filter(|own| own.is_read);
            read.map(|own| own.parameter.word(own.parameter.default)).collect()
        };
        self.fingerprint() == other.fingerprint() && words(self) == words(other)
    }

    /// Where a global variable or an entry point is declared; for one that is not, where the module itself begins.
    pub fn place_of(&self, name: &str) -> Place {
        let variables = self.module.global_variables.iter();
        let variable = variables
            .filter(|(_, variable)| variable.name.as_deref() == Some(name))
            .find_map(|(handle, _)| self.module.global_variables.get_span(handle).to_range());
        let declared = variable.or_else(|| {
            let start = self.text.find(&format!("fn {name}("))?;
            Some(start..start + 3 + name.len())
        });
        match declared {
            Some(range) => self.place(range),
            None => Place::new(self.root.clone(), 0..0),
        }
    }

    /// Gives every loop an end after `rounds` rounds of all loops of an invocation: [`LOOP_FAULTS`](super::LOOP_FAULTS)
    /// becomes a binding of those entry points that have loops. Returns the places of the loops, in the order of their
    /// numbers, of which the first is `first`.
    pub fn limit_loops(&mut self, rounds: u32, first: u32) -> Result<Vec<Place>, ShaderError> {
        let spans = on_large_stack(|| {
            let spans = budget::limit_loops(&mut self.module, rounds, first);
            self.info = check::validate(&self.module, &self.text, &self.map, &self.features)?;
            Ok::<_, ShaderError>(spans)
        })?;
        Ok(spans.into_iter().map(|span| self.place(span.to_range().unwrap_or(0..0))).collect())
    }

    /// Warnings of variables that each invocation has for itself and that are large: drivers that draw on the processor
    /// take them apart into numbers. Mesa 22 compiles 16 KiB as fast as nothing, 64 KiB in 20 s, and 256 KiB without end.
    pub fn large_variables(&self) -> Vec<ShaderError> {
        const LARGE: u32 = 16 << 10;
        let module = &self.module;
        let entries = module.entry_points.iter().map(|entry| &entry.function);
        let functions = module.functions.iter().map(|(_, function)| function).chain(entries);
        let locals = functions.flat_map(|function| {
            let variables = function.local_variables.iter();
            variables.map(|(handle, variable)| (&variable.name, variable.ty, function.local_variables.get_span(handle)))
        });
        let globals = module.global_variables.iter();
        let globals = globals.filter(|(_, variable)| variable.space == naga::AddressSpace::Private);
        let globals =
            globals.map(|(handle, variable)| (&variable.name, variable.ty, module.global_variables.get_span(handle)));
        let mut warnings = Vec::new();
        for (name, ty, span) in globals.chain(locals) {
            let bytes = module.types[ty].inner.size(module.to_ctx());
            if bytes > LARGE {
                let name = name.as_deref().unwrap_or("_");
                let message = format!("`{name}` takes {bytes} bytes in each invocation");
                let place = self.place(span.to_range().unwrap_or_else(|| self.map.first_declaration()));
                warnings.push(ShaderError::of(ErrorKind::Slow, place, message).help(
                    "drivers that draw on the processor take minutes to compile this, or do not end: use a smaller array, \
                     a constant, workgroup memory or a storage buffer",
                ));
            }
        }
        warnings
    }

    fn place(&self, range: Range<usize>) -> Place {
        let (source, range) = self.map.origin(range);
        Place::new(source.clone(), range)
    }
}

impl Library {
    /// Joins a module and all it imports, directly or not, validates them and compares the shared structs' layouts.
    ///
    /// Fails on the first thing that is wrong, at its place in the file that holds it.
    pub fn link(&self, module: &str, features: &Features) -> Result<Linked, ShaderError> {
        on_large_stack(|| link(self, module, features))
    }
}

fn link(library: &Library, root: &str, features: &Features) -> Result<Linked, ShaderError> {
    let closure = Closure::gather(library, root, features)?;
    let owners = closure.owners()?;
    closure.check_uses(&owners)?;
    closure.check_shared(library)?;
    closure.check_parameters()?;
    let (text, map) = closure.joined(library, features)?;
    let (mut module, info) = check::check(&text, &map, &closure.generated, library, features)?;
    closure.try_probes(library, root, features)?;
    let read = values::settle(&mut module);
    let linked = |(word, parameter): (usize, &Parameter)| LinkedParameter {
        parameter: parameter.clone(),
        is_read: read.contains(&word),
    };
    let parameters = closure.parameters().enumerate().map(linked).collect();
    let listeners = if closure.probes().next().is_some() { probe::listeners() } else { Features::new() };
    let named = closure.modules.iter().flat_map(|(_, module)| &module.features).chain(&listeners);
    let edited = closure.modules.iter().any(|(name, _)| !library.is_embedded(name));
    let limited = edited || library.is_limited();
    let (_, last) = closure.modules.last().expect("invariant: a closure ends in the module that was asked for");
    Ok(Linked {
        module,
        info,
        parameters,
        edited,
        limited,
        root: last.source.clone(),
        imports: closure.modules.iter().map(|(name, _)| name.clone()).collect(),
        features: named.filter(|name| features.contains(*name)).cloned().collect(),
        text,
        map,
    })
}

/// A module and all it imports, each behind what it imports itself.
struct Closure {
    modules: Vec<(String, Module)>,
    generated: Generated,
}

impl Closure {
    fn gather(library: &Library, root: &str, features: &Features) -> Result<Closure, ShaderError> {
        let mut walk = Walk { library, features, path: Vec::new(), done: Vec::new() };
        walk.visit(root)?;
        let modules = walk.done;
        let imports = modules.iter().flat_map(|(_, module)| &module.imports);
        let names = imports.filter(|import| import.module == "gen").map(|import| import.item.name.as_str()).collect();
        let generated = library.shared().generate(&names);
        let mut closure = Closure { generated, modules };
        if closure.parameters().next().is_some() {
            let declaration = values::declaration(closure.parameters());
            closure.generated = closure.generated.with_values(&declaration);
        }
        Ok(closure)
    }

    /// Those of all modules, in order.
    fn parameters(&self) -> impl Iterator<Item = &Parameter> {
        self.modules.iter().flat_map(|(_, module)| &module.parameters)
    }

    /// Refuses a parameter's name that a module which knows it gives to something else: a name is replaced wherever it stands.
    fn check_parameters(&self) -> Result<(), ShaderError> {
        for parameter in self.parameters() {
            let name = &parameter.name;
            let taken = self.modules.iter().find(|(_, module)| module.knows(name) && module.locals.contains(name));
            if let Some((module, _)) = taken {
                let message = format!(
                    "`{name}` is a parameter, and `{module}` has something else of that name inside a function or struct"
                );
                return Err(ShaderError::of(ErrorKind::Duplicate, parameter.place.clone(), message)
                    .help("give one of both another name"));
            }
        }
        Ok(())
    }

    /// Which module declares each name: a place in `modules`, or None for the generated one.
    fn owners(&self) -> Result<BTreeMap<&str, Option<usize>>, ShaderError> {
        self.check_number()?;
        let mut owners = BTreeMap::new();
        let mut first: BTreeMap<&str, (&Arc<Source>, Range<usize>)> = BTreeMap::new();
        for name in &self.generated.names {
            owners.insert(name.as_str(), None);
            first.insert(name, (&self.generated.source, 0..0));
        }
        for (index, (_, module)) in self.modules.iter().enumerate() {
            for declared in &module.declarations {
                let name = declared.name.as_str();
                if let Some((source, range)) = first.get(name) {
                    let first = Place::new((*source).clone(), range.clone());
                    let at = format!("{}:{}:{}", first.source.file, first.line, first.column);
                    let message = format!("`{name}` is declared twice: first at {at}");
                    return Err(ShaderError::at(ErrorKind::Duplicate, &module.source, declared.range.clone(), message));
                }
                owners.insert(name, Some(index));
                first.insert(name, (&module.source, declared.range.clone()));
            }
        }
        Ok(owners)
    }

    /// Refuses more declarations than naga can put in order.
    fn check_number(&self) -> Result<(), ShaderError> {
        let mut all =
            self.modules.iter().flat_map(|(_, module)| module.declarations.iter().map(move |one| (module, one)));
        let Some((module, declared)) = all.nth(depth::DECLARATIONS) else { return Ok(()) };
        let message = format!("with what it imports this declares more than {} names", depth::DECLARATIONS);
        Err(ShaderError::at(ErrorKind::Syntax, &module.source, declared.range.clone(), message)
            .help("leave out what is not used, or put numbers into one array"))
    }

    /// Refuses a name of another module that is used without an import. Names that the module also declares somewhere
    /// inside a function or struct pass, since no scopes are known here.
    fn check_uses(&self, owners: &BTreeMap<&str, Option<usize>>) -> Result<(), ShaderError> {
        for (index, (_, module)) in self.modules.iter().enumerate() {
            let imported: BTreeSet<&str> = module.imports.iter().map(|import| import.item.name.as_str()).collect();
            for used in &module.uses {
                let name = used.name.as_str();
                let Some(&owner) = owners.get(name) else { continue };
                if owner == Some(index) || imported.contains(name) || module.locals.contains(name) {
                    continue;
                }
                let path = owner.map_or("gen".to_owned(), |owner| self.modules[owner].0.replace('/', "::"));
                let message = format!("`{name}` is not imported here");
                return Err(ShaderError::at(ErrorKind::Import, &module.source, used.range.clone(), message)
                    .help(format!("import package::{path}::{name};")));
            }
        }
        Ok(())
    }

    /// Refuses a struct of a name that `package::gen` has: a binding of that type would have another layout than the buffer
    /// that Rust fills.
    fn check_shared(&self, library: &Library) -> Result<(), ShaderError> {
        for declared in self.modules.iter().flat_map(|(_, module)| module.declarations.iter().map(move |d| (module, d)))
        {
            let (module, Named { name, range }) = declared;
            if library.shared().is_struct(name) {
                let message = format!("`{name}` is shared with Rust, and package::gen declares it");
                return Err(ShaderError::at(ErrorKind::Duplicate, &module.source, range.clone(), message)
                    .help(format!("import package::gen::{name};")));
            }
        }
        Ok(())
    }

    /// The numbers that its modules show, with the modules that do, in order.
    fn probes(&self) -> impl Iterator<Item = (&Module, &Call)> {
        self.modules.iter().flat_map(|(_, module)| module.probes.iter().map(move |call| (module, call)))
    }

    /// One text, in which numbers that are shown are heard, where somebody listens.
    fn joined(&self, library: &Library, features: &Features) -> Result<(String, SourceMap), ShaderError> {
        let count = self.probes().count();
        if count == 0 || !probe::is_heard(features) {
            return Ok(self.join(&[]));
        }
        let names = library.probes();
        probe::check_number(&names)?;
        let asking: Vec<String> = (0..count).map(probe::asking).collect();
        let (text, map) = self.join(&asking);
        let functions = probe::functions(&check::parse(&text, &map, library, features)?, count);
        let calls = self.probes().zip(functions).map(|((module, call), function)| {
            let function = function.map_err(|ty| probe::unknown_type(&module.source, call, &ty))?;
            let number = names.partition_point(|known| known.name < call.name);
            Ok(probe::calling(function, number))
        });
        let calls = calls.collect::<Result<Vec<String>, ShaderError>>()?;
        Ok(self.join(&calls))
    }

    /// Tells what is wrong with numbers that are shown where nobody listens.
    fn try_probes(&self, library: &Library, root: &str, features: &Features) -> Result<(), ShaderError> {
        if self.probes().next().is_none() || probe::is_heard(features) {
            return Ok(());
        }
        let heard = features.iter().cloned().chain([probe::TRIED.to_owned()]).collect();
        link(library, root, &heard).map(|_| ())
    }

    /// One text: directives, generated declarations, modules. `calls` stand in the places of what is before the values that are shown; none
    /// where nobody listens.
    fn join(&self, calls: &[String]) -> (String, SourceMap) {
        let mut text = String::new();
        let mut map = SourceMap::default();
        for (_, module) in &self.modules {
            for range in &module.directives {
                map.append(&mut text, &module.source.text[range.clone()], &module.source, range.start);
            }
        }
        map.append(&mut text, &self.generated.source.text, &self.generated.source, 0);
        let parameters: BTreeMap<&str, &Parameter> = self.parameters().map(|own| (own.name.as_str(), own)).collect();
        let mut calls = calls.iter();
        for (_, module) in &self.modules {
            let read = module.uses.iter().filter(|used| module.knows(&used.name)).filter_map(|used| {
                let parameter = parameters.get(used.name.as_str())?;
                Some((&used.range, values::access(parameter)))
            });
            let shown = module.probes.iter().zip(&mut calls).map(|(call, by)| (&call.head, by.clone()));
            let mut replaced: Vec<_> = read.chain(shown).collect();
            replaced.sort_by_key(|(range, _)| range.start);
            map.append_replaced(&mut text, &module.text, &module.source, replaced.into_iter());
        }
        (text, map)
    }
}

/// The way through the imports, depth first.
struct Walk<'a> {
    library: &'a Library,
    features: &'a Features,
    /// The modules that are being visited, outermost first.
    path: Vec<String>,
    done: Vec<(String, Module)>,
}

impl Walk<'_> {
    fn visit(&mut self, name: &str) -> Result<(), ShaderError> {
        let module = self.library.scan(name, self.features)?;
        self.path.push(name.to_owned());
        for import in &module.imports {
            self.follow(&module.source, import)?;
        }
        if let Some(call) = module.probes.first().filter(|_| probe::is_heard(self.features)) {
            let [listener, function] = probe::CALLED.map(str::to_owned);
            let item = Named { name: function, range: call.head.clone() };
            self.follow(&module.source, &Import { module: listener, item })?;
        }
        self.path.pop();
        self.done.push((name.to_owned(), module));
        Ok(())
    }

    fn follow(&mut self, source: &Arc<Source>, import: &Import) -> Result<(), ShaderError> {
        let Import { module, item } = import;
        let error = |kind, message: String| ShaderError::at(kind, source, item.range.clone(), message);
        if module == "gen" {
            if self.library.shared().knows(&item.name) {
                return Ok(());
            }
            return Err(error(ErrorKind::Import, format!("package::gen has no struct or constant `{}`", item.name)));
        }
        if let Some(start) = self.path.iter().position(|name| name == module) {
            let cycle = format!("{} -> {module}", self.path[start..].join(" -> "));
            return Err(error(ErrorKind::Cycle, format!("these modules import each other: {cycle}")));
        }
        if !self.library.has(module) {
            let missing = error(ErrorKind::Import, format!("there is no module `{module}`"));
            let whole = format!("{module}/{}", item.name);
            return Err(if self.library.has(&whole) {
                missing.help(format!("`{whole}` is a module: name what to take from it"))
            } else {
                missing
            });
        }
        if !self.done.iter().any(|(name, _)| name == module) {
            self.visit(module).map_err(|mut inner| {
                if inner.place.is_none() {
                    inner.place = Some(Box::new(Place::new(source.clone(), item.range.clone())));
                }
                inner
            })?;
        }
        let imported = self.done.iter().find(|(name, _)| name == module);
        if imported.is_some_and(|(_, scanned)| scanned.declarations.iter().any(|known| known.name == item.name)) {
            return Ok(());
        }
        let none = error(ErrorKind::Import, format!("`{module}` declares no `{}` under these features", item.name));
        Err(if probe::is_call(&item.name) { none.help(probe::NO_IMPORT) } else { none })
    }
}
