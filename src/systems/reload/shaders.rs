//! The folder of shaders: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::compile::Saved;
use super::worker::Look;
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

    pub fn folder(&self) -> &Path {
        &self.folder
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
