//! The shader files: embedded in the binary, read from a folder, or put in by a test.

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::files;
use crate::layout::{GpuConst, StructLayout};

use super::Features;
use super::error::{ErrorKind, ShaderError, Source};
use super::generated::Shared;
use super::link::{self, Linked};
use super::module::{self, Module};
use super::names;

/// Every file of shaders/: (module, text).
static EMBEDDED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Features of a module up to which every set of them is listed.
const MOST_NAMED: usize = 5;

/// Bytes that a file of shaders may have.
const LIMIT: u64 = 16 << 20;

/// A set of modules that import each other.
#[derive(Clone)]
pub struct Library {
    /// Before the module's name in messages: `shaders`.
    folder: String,
    /// By name; one that can't be read keeps the reason.
    modules: BTreeMap<String, Result<Arc<Source>, String>>,
    /// The folders below that can't be read, each with the reason: no module in them is known.
    unread: Vec<(String, String)>,
    shared: Shared,
}

impl Library {
    fn empty(folder: String) -> Self {
        Library { folder, modules: BTreeMap::new(), unread: Vec::new(), shared: Shared::registered() }
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
                library.insert(&name, read_text(&path).map_err(|error| error.to_string()));
            }
        }
        let unread = |(path, error): (PathBuf, std::io::Error)| {
            Some((slashes(path.strip_prefix(folder).ok()?), error.to_string()))
        };
        library.unread = found.unread.into_iter().filter_map(unread).collect();
        Ok(library)
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
        self.insert(module, Ok(text.to_owned()));
        self
    }

    /// The library with more shared structs and constants in `package::gen`.
    pub fn with_layouts(mut self, structs: &[&'static StructLayout], consts: &'static [GpuConst]) -> Self {
        self.shared.add(structs, consts);
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

    /// The sets of features that make a difference to a module: all of them, or where its closure's conditions name more
    /// than five, so many that every two features meet on and on, on and off, off and off: none, each by itself, each
    /// pair, all but one, and all.
    pub fn feature_sets(&self, module: &str) -> Result<Vec<Features>, ShaderError> {
        let named: Vec<String> = self.link(module, &self.features()?)?.features.into_iter().collect();
        let count = named.len();
        let listed = |set: &u64| {
            let on = set.count_ones() as usize;
            count <= MOST_NAMED || on <= 2 || on + 1 >= count
        };
        let chosen = |set: u64| (0..count).filter(|bit| set >> bit & 1 == 1).map(|bit| named[bit].clone()).collect();
        Ok((0..1 << count).filter(listed).map(chosen).collect())
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
            Err(reason) => reason.hash(&mut hasher),
        }
        Some(hasher.finish())
    }

    /// Joins a module and all it imports, directly or not, validates them and compares the shared structs' layouts.
    ///
    /// Fails on the first thing that is wrong, at its place in the file that holds it.
    pub fn link(&self, module: &str, features: &Features) -> Result<Linked, ShaderError> {
        link::link(self, module, features)
    }

    /// Whether all modules have the same texts.
    pub fn is_same(&self, other: &Library) -> bool {
        let hashes = |library: &Library| library.modules().map(|name| (name.to_owned(), library.hash(name))).collect();
        let [own, others]: [Vec<(String, Option<u64>)>; 2] = [self, other].map(hashes);
        own == others
    }

    pub(super) fn shared(&self) -> &Shared {
        &self.shared
    }

    /// Reads a module under some features.
    pub(super) fn scan(&self, name: &str, features: &Features) -> Result<Module, ShaderError> {
        match self.modules.get(name) {
            Some(Ok(source)) => module::scan(source, features),
            Some(Err(reason)) => {
                let message = format!("{}/{name}.wgsl: this file can't be read: {reason}", self.folder);
                Err(ShaderError::nowhere(ErrorKind::Read, message))
            }
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

    fn insert(&mut self, module: &str, text: Result<String, String>) {
        let file = format!("{}/{module}.wgsl", self.folder);
        self.modules.insert(module.to_owned(), text.map(|text| Arc::new(Source { file, text })));
    }
}

/// The text of a file, without its byte order mark.
fn read_text(path: &Path) -> std::io::Result<String> {
    let text =
        String::from_utf8(files::read(path, LIMIT)?).map_err(|_| std::io::Error::other("it is not UTF-8 text"))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// A path as it is told, the same on every system.
fn slashes(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}
