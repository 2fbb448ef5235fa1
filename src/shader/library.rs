//! The shader files: embedded in the binary, read from a folder, or put in by a test.

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::files;
use crate::layout::{GpuConst, StructLayout, Vectors};

use super::Features;
use super::error::{ErrorKind, ShaderError, Source};
use super::generated::Shared;
use super::module::{self, Module};
use super::names;
use super::parameter::{self, Parameter};
use super::probe::{self, Probe};
use super::token;

/// Every file of shaders/: (module, text).
static EMBEDDED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Bytes that a file of shaders may have.
const LIMIT: u64 = 16 << 20;

/// A set of modules that import each other.
#[derive(Clone)]
pub struct Library {
    /// Before the module's name in messages: `shaders`.
    folder: String,
    /// By name; one that can't be read keeps the reason.
    modules: BTreeMap<String, Result<Arc<Source>, ShaderError>>,
    /// The folders below that can't be read, each with the reason: no module in them is known.
    unread: Vec<(String, String)>,
    shared: Shared,
    /// The loops of all its modules are limited, not of edited ones alone.
    limited: bool,
}

impl Library {
    fn empty(folder: String) -> Self {
        Library { folder, modules: BTreeMap::new(), unread: Vec::new(), shared: Shared::registered(), limited: false }
    }

    /// The shaders that this binary was built with.
    pub fn embedded() -> Self {
        let library = Library::empty("shaders".to_owned());
        EMBEDDED.iter().fold(library, |library, (module, text)| library.with(module, text))
    }

    /// The `.wgsl` files below a folder, as far as an import can name them. A file that can't be read is an error only when
    /// something imports it.
    pub fn open(folder: &Path) -> Result<Self, ShaderError> {
        let mut library = Library::empty(slashes(folder));
        let found = files::walk(folder, files::DEEPEST, names::is_shader).map_err(|error| {
            let error = files::explained(folder, error);
            let message = format!("{}: this folder of shaders can't be read: {error}", library.folder);
            ShaderError::nowhere(ErrorKind::Read, message)
        })?;
        for path in found.files {
            if let Some(name) = path.strip_prefix(folder).ok().and_then(names::module_name) {
                let source = library.read(&name, &path);
                library.modules.insert(name, source);
            }
        }
        let unread = |(path, error): (PathBuf, std::io::Error)| {
            Some((slashes(path.strip_prefix(folder).ok()?), error.to_string()))
        };
        library.unread = found.unread.into_iter().filter_map(unread).collect();
        Ok(library)
    }

    /// The files of a folder that lies elsewhere than on the disk: the path of each below it, with `/`, and its bytes. `folder` stands
    /// before that path in messages. Files that no import can name are passed over.
    pub fn of(folder: &str, files: impl IntoIterator<Item = (String, Vec<u8>)>) -> Self {
        let mut library = Library::empty(folder.to_owned());
        for (path, bytes) in files {
            let path = Path::new(&path);
            if let Some(name) = names::module_name(path).filter(|_| names::is_shader(path)) {
                let source = library.decode(&name, &bytes);
                library.modules.insert(name, source);
            }
        }
        library
    }

    /// `./shaders` where that is a folder of ours, else the embedded ones.
    pub fn shipped() -> Self {
        Library::local_folder().and_then(|folder| Library::open(folder).ok()).unwrap_or_else(Library::embedded)
    }

    /// `./shaders`, where that is a folder of ours.
    pub fn local_folder() -> Option<&'static Path> {
        let folder = Path::new("shaders");
        (folder.join("passes").is_dir() && folder.join("lib").is_dir()).then_some(folder)
    }

    /// The library with one module replaced or added.
    pub fn with(mut self, module: &str, text: &str) -> Self {
        let source = self.source(module, text.to_owned());
        self.modules.insert(module.to_owned(), Ok(source));
        self
    }

    /// The library, and beside its modules those of `base` that it lacks: a folder may hold only what it changes.
    pub fn laid_over(mut self, base: &Library) -> Self {
        for (name, module) in &base.modules {
            self.modules.entry(name.clone()).or_insert_with(|| module.clone());
        }
        self
    }

    /// The library with the loops of all modules limited, as those of edited ones are: counting their rounds costs 5 to 12 % of the
    /// speed of tracing (MEASUREMENTS.md), which is not an edit's fault.
    pub fn with_limited_loops(self) -> Self {
        Library { limited: true, ..self }
    }

    /// Whether all loops are limited.
    pub(super) fn is_limited(&self) -> bool {
        self.limited
    }

    /// The library with more shared structs and constants in `package::gen`.
    pub fn with_layouts(mut self, structs: &[&'static StructLayout], consts: &'static [GpuConst]) -> Self {
        self.shared.add(structs, consts);
        self
    }

    /// The library with the unpacking of more structs in `package::gen`; they are among its shared structs.
    pub fn with_vectors(mut self, vectors: &[Vectors]) -> Self {
        self.shared.add_vectors(vectors);
        self
    }

    /// The names of all modules, in order.
    pub fn modules(&self) -> impl Iterator<Item = &str> {
        self.modules.keys().map(String::as_str)
    }

    /// Every feature that a condition of any module names. What can't be read names none.
    pub fn features(&self) -> Result<Features, ShaderError> {
        let mut named = Features::new();
        for module in self.modules().filter(|module| self.text(module).is_some()) {
            named.extend(self.scan(module, &Features::new())?.features);
        }
        Ok(named)
    }

    /// Every parameter that any module declares, by name. What can't be read, or is no WGSL, declares none; two of one name are an error,
    /// wherever they are: they are set by it.
    pub fn parameters(&self) -> Result<Vec<Parameter>, ShaderError> {
        let mut found: BTreeMap<String, Parameter> = BTreeMap::new();
        let may_declare = |source: &&Arc<Source>| ["override", "@range"].iter().any(|word| source.text.contains(word));
        for source in self.modules.values().flatten().filter(may_declare) {
            let Ok(tokens) = token::tokenize(source) else { continue };
            for parameter in parameter::all_of(source, &tokens)? {
                if let Some(first) = found.get(&parameter.name) {
                    let (name, at) = (&parameter.name, &first.place);
                    let at = format!("{}:{}:{}", at.source.file, at.line, at.column);
                    let message = format!("`override {name}` is declared twice: first at {at}");
                    return Err(ShaderError::of(ErrorKind::Duplicate, parameter.place, message)
                        .help("a parameter is set by its name: declare it in one module, and import it from there"));
                }
                found.insert(parameter.name.clone(), parameter);
            }
        }
        Ok(found.into_values().collect())
    }

    /// Every name that code of any module shows numbers by, in order: the place of one is its number. What can't be read, or is no WGSL, has
    /// none; a call that is wrong is linking's to tell.
    pub fn probes(&self) -> Vec<Probe> {
        let mut names = BTreeMap::new();
        for source in self.modules.values().flatten().filter(|source| source.text.contains("probe")) {
            if let Ok(tokens) = token::tokenize(source) {
                probe::add_names(source, &tokens, &mut names);
            }
        }
        names.into_values().collect()
    }

    /// The text of a module as it was read; None for one that is unknown or can't be read.
    pub fn text(&self, module: &str) -> Option<&str> {
        self.modules.get(module)?.as_ref().ok().map(|source| source.text.as_str())
    }

    /// A number that changes with the module's text, the same in every process; None for an unknown module.
    pub fn hash(&self, module: &str) -> Option<u64> {
        let mut hasher = DefaultHasher::new();
        match self.modules.get(module)? {
            Ok(source) => source.text.hash(&mut hasher),
            Err(error) => {
                error.message.hash(&mut hasher);
                error.place.as_ref().map(|place| &place.source.text).hash(&mut hasher);
            }
        }
        Some(hasher.finish())
    }

    /// Whether all modules have the same texts.
    pub fn is_same(&self, other: &Library) -> bool {
        self.hashes() == other.hashes()
    }

    /// Of all modules, by their names.
    pub fn hashes(&self) -> BTreeMap<String, Option<u64>> {
        self.modules().map(|name| (name.to_owned(), self.hash(name))).collect()
    }

    pub(super) fn shared(&self) -> &Shared {
        &self.shared
    }

    /// Reads a module under some features.
    pub(super) fn scan(&self, name: &str, features: &Features) -> Result<Module, ShaderError> {
        match self.modules.get(name) {
            Some(Ok(source)) => module::scan(source, features),
            Some(Err(error)) => Err(error.clone()),
            None => Err(self.unknown(name)),
        }
    }

    /// Why a module is not there.
    fn unknown(&self, name: &str) -> ShaderError {
        let holds = |folder: &str| name.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'));
        if let Some((folder, reason)) = self.unread.iter().find(|(folder, _)| holds(folder)) {
            let message = format!("{}/{folder}: this folder can't be read: {reason}", self.folder);
            return ShaderError::nowhere(ErrorKind::Read, message);
        }
        ShaderError::nowhere(ErrorKind::Import, format!("there is no shader `{name}`"))
            .help(format!("shaders are named by their path below {}/, without .wgsl", self.folder))
    }

    /// Whether a module is, to the byte, the one that this binary was built with.
    pub(super) fn is_embedded(&self, name: &str) -> bool {
        EMBEDDED.iter().any(|(module, text)| *module == name && self.text(name) == Some(text))
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.modules.contains_key(name)
    }

    fn source(&self, module: &str, text: String) -> Arc<Source> {
        Arc::new(Source { file: format!("{}/{module}.wgsl", self.folder), text })
    }

    /// What a file of the folder holds: text, or what is wrong with it.
    fn read(&self, module: &str, path: &Path) -> Result<Arc<Source>, ShaderError> {
        let bytes = files::read(path, LIMIT).map_err(|error| {
            let message = format!("{}/{module}.wgsl: this file can't be read: {error}", self.folder);
            ShaderError::nowhere(ErrorKind::Read, message)
        })?;
        self.decode(module, &bytes)
    }

    /// What the bytes of a file say.
    fn decode(&self, module: &str, bytes: &[u8]) -> Result<Arc<Source>, ShaderError> {
        let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(self.source(module, text.to_owned())),
            Err(error) => {
                let at = error.valid_up_to();
                let source = self.source(module, String::from_utf8_lossy(bytes).into_owned());
                let message = format!("byte {at} of this file, 0x{:02x}, is not UTF-8", bytes[at]);
                Err(ShaderError::at(ErrorKind::Read, &source, at..at, message).help(match bytes {
                    [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "it is UTF-16: save it as UTF-8".to_owned(),
                    _ => format!("save it as UTF-8; in Latin-1 this byte is `{}`", char::from(bytes[at])),
                }))
            }
        }
    }
}

/// A path as it is told, the same on every system.
fn slashes(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}
