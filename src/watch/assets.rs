//! The scene file and all it names: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::Hasher;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::event::problems_of;
use super::message::Look;
use crate::files::{self, Stamp};
use crate::scene::{self, Loaded, SceneDescription};

/// What the command line says over a scene file.
pub type Adjust = Box<dyn Fn(&mut SceneDescription) + Send>;

/// A scene file, and how it is read.
pub struct WatchedScene {
    pub path: PathBuf,
    /// As for [`scene::load`].
    pub defines: Vec<(String, String)>,
    /// Done to every description that is loaded.
    pub adjust: Adjust,
}

/// The files of a scene as they were last seen.
pub struct SceneFiles {
    scene: WatchedScene,
    seen: BTreeMap<PathBuf, Seen>,
}

/// A file's stamp and contents; of what is no file, or can't be read, nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Seen {
    stamp: Option<Stamp>,
    length: u64,
    hash: u64,
}

impl SceneFiles {
    /// `files` are those that were read for what runs now.
    pub fn new(scene: WatchedScene, files: &[PathBuf]) -> Self {
        let mut this = Self { scene, seen: BTreeMap::new() };
        this.see(files);
        this
    }

    /// The folders that hold the files, and links on the way to them.
    pub fn folders(&self) -> impl Iterator<Item = PathBuf> {
        self.seen.keys().flat_map(|file| files::trail(file))
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
        let Ok(stamp) = Stamp::of(path) else { return Seen::default() };
        if let Some(old) = old
            && old.stamp.as_ref() == Some(&stamp)
            && !stamp.is_young()
        {
            return old.clone();
        }
        match contents(path) {
            Ok((length, hash)) => Seen { stamp: Some(stamp), length, hash },
            Err(_) => Seen::default(),
        }
    }
}

/// Bytes of a file, and their hash.
fn contents(path: &Path) -> std::io::Result<(u64, u64)> {
    let mut file = files::open_regular(path)?;
    let (mut hasher, mut length) = (DefaultHasher::new(), 0);
    let mut part = vec![0; 1 << 18];
    loop {
        match file.read(&mut part) {
            Ok(0) => return Ok((length, hasher.finish())),
            Ok(read) => {
                hasher.write(&part[..read]);
                length += read as u64;
            }
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
