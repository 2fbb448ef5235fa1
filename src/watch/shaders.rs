//! The folder of shaders: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::compile::Saved;
use super::message::Look;
use super::watcher::Place;
use crate::files::{self, trail};
use crate::shader::Library;

/// A folder of shaders as it was last seen.
pub struct ShaderFolder {
    folder: PathBuf,
    /// Hash of each module's text, by its name.
    seen: BTreeMap<String, Option<u64>>,
}

impl ShaderFolder {
    /// `library` is what runs now, as it was read from the folder.
    pub fn new(folder: PathBuf, library: &Library) -> Self {
        Self { folder, seen: hashes(library) }
    }

    /// What is to be watched: the folder with all below it, and where links lead that are in it or on the way to it.
    pub fn places(&self) -> Vec<Place> {
        let mut places = vec![Place { folder: self.folder.clone(), below: true }];
        let mut add = |path: &Path| places.extend(trail(path).into_iter().map(|folder| Place { folder, below: false }));
        add(&self.folder);
        if let Ok(found) = files::walk(&self.folder, files::DEEPEST, |_| true) {
            found.files.iter().for_each(|file| add(file));
            // A folder behind a link is found by a way of its own, also while there is no file in it.
            found.folders.iter().for_each(|folder| add(&folder.join("*")));
        }
        places
    }

    /// Reads the folder, if it holds other code now. `patient`: a file that is empty or gone is being saved.
    pub fn look(&mut self, patient: bool, force: bool) -> Look<Saved> {
        let library = match Library::open(&self.folder) {
            Ok(library) => library,
            Err(_) if patient => return Look::Unfinished,
            Err(error) => {
                // Told once. Whatever comes back is another folder, also with the same files in it.
                if self.seen.is_empty() {
                    return Look::Same;
                }
                self.seen.clear();
                return Look::Changed { files: vec![self.folder.clone()], result: Err(vec![error.into()]) };
            }
        };
        let now = hashes(&library);
        let mut changed: Vec<&String> =
            now.iter().filter(|(name, hash)| self.seen.get(*name) != Some(hash)).map(|(name, _)| name).collect();
        changed.extend(self.seen.keys().filter(|name| !now.contains_key(*name)));
        if changed.is_empty() && !force {
            return Look::Same;
        }
        let unfinished = |name: &&String| library.text(name).is_none_or(|text| text.trim().is_empty());
        if patient && changed.iter().any(unfinished) {
            return Look::Unfinished;
        }
        let files = changed.iter().map(|name| self.folder.join(format!("{name}.wgsl"))).collect();
        let edited = changed.into_iter().cloned().collect();
        self.seen = now;
        Look::Changed { files, result: Ok(Saved { library, edited }) }
    }
}

fn hashes(library: &Library) -> BTreeMap<String, Option<u64>> {
    library.modules().map(|name| (name.to_owned(), library.hash(name))).collect()
}
