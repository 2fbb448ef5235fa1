//! The folders of shaders: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::path::Path;

use super::message::{Look, Saved};
use super::watcher::Place;
use crate::files::{self, trail};
use crate::shader::{Layers, Library};

/// Folders of shaders as they were last seen.
pub struct ShaderFolders {
    layers: Layers,
    /// Hash of each module's text, by its name.
    seen: BTreeMap<String, Option<u64>>,
    /// Others were chosen since: what they hold otherwise was not saved.
    chosen: bool,
}

impl ShaderFolders {
    /// `library` is what runs now, as it was read from the folders.
    pub fn new(layers: Layers, library: &Library) -> Self {
        Self { layers, seen: hashes(library), chosen: false }
    }

    /// Reads others from the next look on. Says whether they are others.
    pub fn choose(&mut self, layers: &Layers) -> bool {
        let other = self.layers != *layers;
        if other {
            (self.layers, self.chosen) = (layers.clone(), true);
        }
        other
    }

    /// What is to be watched: the folders with all below them, and where links lead that are in them or on the way to them.
    pub fn places(&self) -> Vec<Place> {
        self.layers.folders().flat_map(places_of).collect()
    }

    /// Reads the folders, if they hold other code now. `patient`: a file that is empty or gone is being saved.
    pub fn look(&mut self, patient: bool, force: bool) -> Look<Saved> {
        let library = match self.layers.read() {
            Ok(library) => library,
            Err(_) if patient => return Look::Unfinished,
            Err(error) => {
                // Told once. Whatever comes back is another folder, also with the same files in it.
                if self.seen.is_empty() && !force {
                    return Look::Same;
                }
                self.seen.clear();
                let files = self.layers.folders().filter(|_| !self.chosen).map(Path::to_path_buf).collect();
                return Look::Changed { files, result: Err(vec![error.into()]) };
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
        let chosen = std::mem::take(&mut self.chosen);
        let files = changed.iter().filter(|_| !chosen).map(|name| self.layers.file(name)).collect();
        let edited = changed.into_iter().cloned().collect();
        self.seen = now;
        Look::Changed { files, result: Ok(Saved { library, edited, again: false }) }
    }
}

/// What is to be watched of one folder.
fn places_of(folder: &Path) -> Vec<Place> {
    let mut places = vec![Place { folder: folder.to_path_buf(), below: true }];
    let mut add = |path: &Path| places.extend(trail(path).into_iter().map(|folder| Place { folder, below: false }));
    add(folder);
    if let Ok(found) = files::walk(folder, files::DEEPEST, |_| true) {
        found.files.iter().for_each(|file| add(file));
        // A folder behind a link is found by a way of its own, also while there is no file in it.
        found.folders.iter().for_each(|folder| add(&folder.join("*")));
    }
    places
}

fn hashes(library: &Library) -> BTreeMap<String, Option<u64>> {
    library.modules().map(|name| (name.to_owned(), library.hash(name))).collect()
}
