//! The shaders of members: each folder is read once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::scene::variants::Member;
use crate::shader::{Library, ShaderError};

/// Of a folder, and the values of its `override`s.
type Wanted = (Option<PathBuf>, BTreeMap<String, String>);

/// Every library that a member wants, by number.
pub struct Codes {
    /// Of members that have no folder of their own; `None` are the built-in ones.
    folder: Option<PathBuf>,
    folders: BTreeMap<Option<PathBuf>, Result<Library, ShaderError>>,
    numbers: BTreeMap<Wanted, usize>,
    libraries: Vec<Library>,
}

impl Codes {
    /// `folder` is for those that have none of their own.
    pub fn new(folder: Option<&Path>) -> Self {
        let folder =
            folder.map_or_else(|| Library::local_folder().map(Path::to_path_buf), |folder| Some(folder.to_path_buf()));
        Self { folder, folders: BTreeMap::new(), numbers: BTreeMap::new(), libraries: Vec::new() }
    }

    /// The number of a member's shaders, or what is wrong with them.
    pub fn number(&mut self, member: &Member) -> Result<usize, String> {
        let folder = member.shaders.clone().or_else(|| self.folder.clone());
        let wanted = (folder.clone(), member.values.clone());
        if let Some(number) = self.numbers.get(&wanted) {
            return Ok(*number);
        }
        let read = || folder.as_deref().map_or_else(|| Ok(Library::embedded()), Library::open);
        let library = self.folders.entry(folder.clone()).or_insert_with(read);
        let library = library.clone().map_err(|error| error.to_string())?;
        if let Some(name) = member.values.keys().next() {
            return Err(format!("shader.{name}: no shader has a value that can be set"));
        }
        // Another folder of the same files is the same code.
        let known = self.libraries.iter().position(|known| known.is_same(&library));
        let number = known.unwrap_or(self.libraries.len());
        if known.is_none() {
            self.libraries.push(library);
        }
        self.numbers.insert(wanted, number);
        Ok(number)
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
