//! The scene file and all it names: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::event::problems_of;
use super::watcher::folder_of;
use super::worker::Look;
use crate::scene::{self, Loaded, SceneDescription};

/// A file as young as this may be written again without another time stamp, so that only its contents can tell.
const YOUNG: Duration = Duration::from_secs(2);

/// What the command line says over a scene file.
pub type Adjust = Box<dyn Fn(&mut SceneDescription) + Send>;

/// A scene file, and how it is read.
pub struct SceneFile {
    pub path: PathBuf,
    /// As for [`scene::load`].
    pub defines: Vec<(String, String)>,
    /// Done to every description that is loaded.
    pub adjust: Adjust,
}

/// The files of a scene as they were last seen.
pub struct SceneFiles {
    scene: SceneFile,
    seen: BTreeMap<PathBuf, Seen>,
}

/// A file's stamp and contents; of a file that is not there, nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Seen {
    length: u64,
    modified: Option<SystemTime>,
    hash: u64,
}

impl SceneFiles {
    /// `files` are those that were read for what runs now.
    pub fn new(scene: SceneFile, files: &[PathBuf]) -> Self {
        let mut this = Self { scene, seen: BTreeMap::new() };
        this.see(files);
        this
    }

    /// The folders that hold the files.
    pub fn folders(&self) -> impl Iterator<Item = PathBuf> {
        self.seen.keys().map(|file| folder_of(file))
    }

    /// Loads the scene anew if any of its files changed. `patient`: a file that is empty or gone is being saved.
    pub fn look(&mut self, patient: bool, force: bool) -> Look<Box<Loaded>> {
        let now: Vec<(PathBuf, Seen)> =
            self.seen.iter().map(|(path, old)| (path.clone(), Seen::of(path, Some(old)))).collect();
        let changed: Vec<&(PathBuf, Seen)> =
            now.iter().filter(|(path, seen)| self.seen[path].hash != seen.hash).collect();
        if changed.is_empty() && !force {
            self.seen.extend(now);
            return Look::Same;
        }
        if patient && changed.iter().any(|(_, seen)| seen.length == 0) {
            return Look::Unfinished;
        }
        let files = changed.into_iter().map(|(path, _)| path.clone()).collect();
        let (mut result, read) = scene::attempt(&self.scene.path, &self.scene.defines);
        // What a broken scene names is not all known: then the old files stay under watch.
        if let Ok(loaded) = &mut result {
            (self.scene.adjust)(&mut loaded.description);
            self.seen.retain(|path, _| read.contains(path));
        }
        self.see(&read);
        let now = now.into_iter().filter(|(path, _)| self.seen.contains_key(path)).collect::<Vec<_>>();
        self.seen.extend(now);
        Look::Changed { files, result: result.map(Box::new).map_err(problems_of) }
    }

    fn see(&mut self, paths: &[PathBuf]) {
        for path in paths {
            let seen = Seen::of(path, self.seen.get(path));
            self.seen.insert(path.clone(), seen);
        }
    }
}

impl Seen {
    /// Looks at a file; reads it only if its stamp is another, or too young to tell.
    fn of(path: &Path, old: Option<&Seen>) -> Seen {
        let Ok(metadata) = fs::metadata(path) else { return Seen::default() };
        let (length, modified) = (metadata.len(), metadata.modified().ok());
        let age = modified.and_then(|time| SystemTime::now().duration_since(time).ok());
        if let Some(old) = old
            && (old.length, old.modified) == (length, modified)
            && age.is_some_and(|age| age > YOUNG)
        {
            return *old;
        }
        let Ok(bytes) = fs::read(path) else { return Seen::default() };
        let mut hasher = DefaultHasher::new();
        bytes.hash(&mut hasher);
        Seen { length: bytes.len() as u64, modified, hash: hasher.finish() }
    }
}
