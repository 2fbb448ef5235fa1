//! Files as they were first read: one snapshot for all scenes that are loaded by it, each file understood once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use super::diagnostic::{Diagnostic, Diagnostics};
use super::model::Imported;
use super::mtl::Library;
use super::sky::Sky;
use super::text::Text;
use super::textures::{Picture, Reduction};
use crate::files::Stamp;

/// What several scenes share, by the paths that lead to it. Threads may load by it at once.
#[derive(Default)]
pub struct Assets {
    shared: Mutex<Shared>,
}

#[derive(Default)]
struct Shared {
    texts: Files<Result<Text, Diagnostic>>,
    models: Files<Imported>,
    libraries: Files<(Option<Library>, Diagnostics)>,
    skies: Files<Sky>,
    /// By real paths: in several sizes, if scenes had less room for them.
    pictures: BTreeMap<PathBuf, (Option<Stamp>, Vec<Picture>)>,
    reads: BTreeMap<PathBuf, u32>,
}

type Files<T> = BTreeMap<PathBuf, Kept<T>>;

/// A file, and the stamp that it had before it was read; none where there was no file, or it may change without another stamp.
struct Kept<T> {
    stamp: Option<Stamp>,
    value: Arc<OnceLock<Arc<T>>>,
}

impl Assets {
    pub fn new() -> Self {
        Self::default()
    }

    /// How often files were read to be understood, all together.
    pub fn count(&self) -> u32 {
        self.lock().reads.values().sum()
    }

    /// How often each file was read to be understood.
    pub fn reads(&self) -> BTreeMap<PathBuf, u32> {
        self.lock().reads.clone()
    }

    /// Forgets what is another file now, for those who watch files.
    pub fn refresh(&self) {
        let Shared { texts, models, libraries, skies, pictures, .. } = &mut *self.lock();
        let mut changed = BTreeSet::new();
        forget(texts, &mut changed);
        forget(libraries, &mut changed);
        forget(skies, &mut changed);
        forget(models, &mut changed);
        // A model has the materials of its libraries, and misses those that were not there.
        models.retain(|path, kept| {
            let files = kept.value.get().map_or(&[] as &[PathBuf], |model| &model.files);
            let appeared = |file: &PathBuf| file != path && !libraries.contains_key(file) && file.is_file();
            !files.iter().any(|file| changed.contains(file) || appeared(file))
        });
        pictures.retain(|path, (stamp, _)| is_same(path, stamp.as_ref()));
    }

    /// Forgets all but some files: what members of a family no longer need.
    pub fn retain(&self, files: &BTreeSet<PathBuf>) {
        let Shared { texts, models, libraries, skies, pictures, .. } = &mut *self.lock();
        texts.retain(|path, _| files.contains(path));
        models.retain(|path, _| files.contains(path));
        libraries.retain(|path, _| files.contains(path));
        skies.retain(|path, _| files.contains(path));
        let real: BTreeSet<PathBuf> = files.iter().filter_map(|path| path.canonicalize().ok()).collect();
        pictures.retain(|path, _| real.contains(path));
    }

    /// The text of a file of at most `limit` bytes, or why there is none.
    pub fn text(&self, path: &Path, limit: u64) -> Arc<Result<Text, Diagnostic>> {
        self.kept(path, |shared| &mut shared.texts, || Text::read(path, limit))
    }

    /// A model and what was told of it.
    pub fn model(&self, path: &Path, read: impl FnOnce() -> Imported) -> Arc<Imported> {
        self.kept(path, |shared| &mut shared.models, read)
    }

    /// A library of materials and what was told of it.
    pub fn library(
        &self,
        path: &Path,
        read: impl FnOnce() -> (Option<Library>, Diagnostics),
    ) -> Arc<(Option<Library>, Diagnostics)> {
        self.kept(path, |shared| &mut shared.libraries, read)
    }

    /// The picture of an environment.
    pub fn sky(&self, path: &Path, read: impl FnOnce() -> Sky) -> Arc<Sky> {
        self.kept(path, |shared| &mut shared.skies, read)
    }

    /// A picture of textures, by its real path, of any size.
    pub fn any_picture(&self, real: &Path) -> Option<Picture> {
        self.lock().pictures.get(real).and_then(|(_, pictures)| pictures.first().cloned())
    }

    /// The same, of one size.
    pub fn picture(&self, real: &Path, reduction: Reduction) -> Option<Picture> {
        let shared = self.lock();
        let (_, pictures) = shared.pictures.get(real)?;
        pictures.iter().find(|picture| picture.facts.reduction.is_like(reduction)).cloned()
    }

    /// Keeps a picture, whose file had a stamp before it was read; none where it was young. `decoded`: it was read just now.
    pub fn keep_picture(&self, real: &Path, stamp: Option<&Stamp>, picture: &Picture, decoded: bool) {
        let mut shared = self.lock();
        if decoded {
            *shared.reads.entry(real.to_path_buf()).or_default() += 1;
        }
        let entry = shared.pictures.entry(real.to_path_buf()).or_insert_with(|| (stamp.cloned(), Vec::new()));
        entry.1.push(picture.clone());
    }

    /// What a file came to, read now if it was not yet. Others who want it wait.
    fn kept<T>(
        &self,
        path: &Path,
        files: impl FnOnce(&mut Shared) -> &mut Files<T>,
        read: impl FnOnce() -> T,
    ) -> Arc<T> {
        let value = {
            let mut shared = self.lock();
            let files = files(&mut shared);
            match files.get(path) {
                Some(kept) => kept.value.clone(),
                None => {
                    let stamp = Stamp::of(path).ok().filter(|stamp| !stamp.is_young());
                    let kept = Kept { stamp, value: Arc::default() };
                    files.entry(path.to_path_buf()).or_insert(kept).value.clone()
                }
            }
        };
        let read = || {
            *self.lock().reads.entry(path.to_path_buf()).or_default() += 1;
            Arc::new(read())
        };
        value.get_or_init(read).clone()
    }

    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Forgets files that are others now, and says which.
fn forget<T>(files: &mut Files<T>, changed: &mut BTreeSet<PathBuf>) {
    files.retain(|path, kept| {
        let same = is_same(path, kept.stamp.as_ref());
        changed.extend((!same).then(|| path.clone()));
        same
    });
}

/// Whether a file has the stamp that it had.
fn is_same(path: &Path, stamp: Option<&Stamp>) -> bool {
    stamp.is_some() && Stamp::of(path).ok().as_ref() == stamp
}
