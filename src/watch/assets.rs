//! The scene file and all it names: which files are other ones than at the last look.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::event::problems_of;
use super::message::Look;
use crate::files::{self, Digest, Stamp};
use crate::scene::{self, Define, Diagnostics, Loaded, SceneDescription};
use crate::shader::Layers;

/// What the command line says over a scene file.
pub type Adjust = Box<dyn Fn(&mut SceneDescription) + Send>;

/// What reads a scene.
pub type Read = Box<dyn FnMut() -> Attempt + Send>;

/// What came of reading a scene.
pub struct Attempt {
    pub scene: Result<Loaded, Diagnostics>,
    /// Every file that was read or looked for.
    pub files: Vec<PathBuf>,
    /// The shaders that it is to be drawn with, where it says so.
    pub shaders: Option<Layers>,
}

/// A scene, and how it is read.
pub struct WatchedScene {
    pub read: Read,
    /// Done to every description that is loaded.
    pub adjust: Adjust,
}

impl WatchedScene {
    /// That of a file, with defines.
    pub fn file(path: PathBuf, defines: Vec<Define>, adjust: Adjust) -> Self {
        let read = move || {
            let (scene, files) = scene::attempt(&path, &defines);
            Attempt { scene, files, shaders: None }
        };
        Self { read: Box::new(read), adjust }
    }
}

/// The files of a scene as they were last seen.
pub struct SceneFiles {
    scene: WatchedScene,
    seen: BTreeMap<PathBuf, Seen>,
    /// What the last good one is to be drawn with.
    pub shaders: Option<Layers>,
}

/// A file's stamp and contents; of what is no file, or can't be read, nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Seen {
    stamp: Option<Stamp>,
    digest: Digest,
}

impl SceneFiles {
    /// `files` are those that were read for what runs now.
    pub fn new(scene: WatchedScene, files: &[PathBuf]) -> Self {
        let mut this = Self { scene, seen: BTreeMap::new(), shaders: None };
        this.see(files);
        this
    }

    /// The folders that hold the files, and links on the way to them.
    pub fn folders(&self) -> impl Iterator<Item = PathBuf> {
        self.seen.keys().flat_map(|file| files::trail(file))
    }

    /// Loads the scene anew if any of its files changed. `patient`: a file that is empty, gone or cut short is being saved, and so is one that
    /// changes while the scene is read; of those that this reading names for the first time, that is not known.
    pub fn look(&mut self, patient: bool, force: bool) -> Look<Box<Loaded>> {
        let now: Vec<(PathBuf, Seen)> =
            self.seen.iter().map(|(path, old)| (path.clone(), Seen::of(path, Some(old)))).collect();
        let changed: Vec<&(PathBuf, Seen)> =
            now.iter().filter(|(path, seen)| self.seen[path].digest.hash != seen.digest.hash).collect();
        if changed.is_empty() && !force {
            self.seen.extend(now);
            return Look::Same;
        }
        if patient && changed.iter().any(|(_, seen)| seen.digest.length == 0) {
            return Look::Unfinished;
        }
        let files: Vec<PathBuf> = changed.into_iter().map(|(path, _)| path.clone()).collect();
        let Attempt { scene: mut result, files: read, shaders } = (self.scene.read)();
        let is_cut_short = |loaded: &Loaded| loaded.unfinished.iter().any(|file| files.contains(file));
        let changes = |(path, seen): &(PathBuf, Seen)| Seen::of(path, Some(seen)).digest != seen.digest;
        if patient && (result.as_ref().is_ok_and(is_cut_short) || now.iter().any(changes)) {
            return Look::Unfinished;
        }
        // What a broken scene names is not all known: then the old files stay under watch.
        if let Ok(loaded) = &mut result {
            (self.scene.adjust)(&mut loaded.description);
            self.shaders = shaders;
            self.seen.retain(|path, _| read.contains(path));
        }
        // What is read again counts as it was before: what became of it meanwhile is for the next look.
        let now = now.into_iter().filter(|(path, _)| self.seen.contains_key(path)).collect::<Vec<_>>();
        self.see(read.iter().filter(|path| now.binary_search_by(|(known, _)| known.cmp(path)).is_err()));
        self.seen.extend(now);
        Look::Changed { files, result: result.map(Box::new).map_err(problems_of) }
    }

    fn see<'p>(&mut self, paths: impl IntoIterator<Item = &'p PathBuf>) {
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
        match Digest::of(path) {
            Ok(digest) => Seen { stamp: Some(stamp), digest },
            Err(_) => Seen::default(),
        }
    }
}
