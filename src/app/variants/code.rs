//! The shaders of members: each folder is read once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::scene::variants::Member;
use crate::shader::{Library, ShaderError};

/// Of all modules of a library.
type Hashes = BTreeMap<String, Option<u64>>;

/// Every library that a member wants, by number.
pub struct Codes {
    /// Of members that have no folder of their own; `None` are the built-in ones.
    folder: Option<PathBuf>,
    folders: BTreeMap<Option<PathBuf>, Result<Library, ShaderError>>,
    numbers: BTreeMap<Option<PathBuf>, usize>,
    libraries: Vec<Library>,
    /// The same by their texts.
    known: BTreeMap<Hashes, usize>,
}

impl Codes {
    /// `folder` is for those that have none of their own.
    pub fn new(folder: Option<&Path>) -> Self {
        let folder =
            folder.map_or_else(|| Library::local_folder().map(Path::to_path_buf), |folder| Some(folder.to_path_buf()));
        Self {
            folder,
            folders: BTreeMap::new(),
            numbers: BTreeMap::new(),
            libraries: Vec::new(),
            known: BTreeMap::new(),
        }
    }

    /// The number of a member's shaders, or what is wrong with them.
    pub fn number(&mut self, member: &Member) -> Result<usize, String> {
        self.number_of(&member.shaders)
    }

    /// The same by the folder of its own that it may have.
    pub fn number_of(&mut self, shaders: &Option<PathBuf>) -> Result<usize, String> {
        if let Some(number) = self.numbers.get(shaders) {
            return Ok(*number);
        }
        let mut library = self.opened(self.folder.clone())?;
        if let Some(folder) = shaders {
            library = self.opened(Some(folder.clone()))?.laid_over(&library);
        }
        // Another folder of the same files is the same code.
        let number = *self.known.entry(library.hashes()).or_insert(self.libraries.len());
        if number == self.libraries.len() {
            self.libraries.push(library);
        }
        self.numbers.insert(shaders.clone(), number);
        Ok(number)
    }

    /// A folder as it is by itself; the built-in shaders without one.
    fn opened(&mut self, folder: Option<PathBuf>) -> Result<Library, String> {
        let read = || folder.as_deref().map_or_else(|| Ok(Library::embedded()), Library::open);
        let library = self.folders.entry(folder.clone()).or_insert_with(read);
        library.clone().map_err(|error| error.to_string())
    }

    /// Limits the loops of all libraries, as those of edited ones are: where their speed is compared, none is to have less to do.
    pub fn limit(&mut self) {
        let limited = self.libraries.drain(..).map(Library::with_limited_loops);
        self.libraries = limited.collect();
    }

    /// The library of a number.
    pub fn library(&self, number: usize) -> &Library {
        &self.libraries[number]
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.libraries.len()
    }
}
