//! Folders under watch. A message says only that something was touched: what changed is told by contents.
//!
//! Folders, not files: editors save by writing another file and renaming it, and a watch follows the old one.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::time::Instant;

use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Config, RecommendedWatcher, RecursiveMode, Watcher};

use super::message::Message;

/// Why nothing can be watched.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("files can't be watched: {reason}")]
#[diagnostic(help("on Linux, the limits fs.inotify.max_user_watches and max_user_instances may be too low"))]
pub struct WatchError {
    reason: String,
}

/// A folder to be watched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    pub folder: PathBuf,
    /// With those below it, but not with what is behind links.
    pub below: bool,
}

/// What came of an attempt to watch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Watched {
    /// All of it could be; else this is to be tried again: a folder that does not exist may come to be.
    pub all: bool,
    /// Something that was not before: what was saved in it meanwhile is not known.
    pub more: bool,
}

/// Sends a message for whatever happens in some folders.
pub struct Folders {
    watcher: RecommendedWatcher,
    /// Real paths, each with or without those below it.
    watched: BTreeMap<PathBuf, bool>,
}

impl Folders {
    /// Watches nothing yet.
    pub fn new(sender: Sender<Message>) -> Result<Self, WatchError> {
        let handler = move |event: notify::Result<notify::Event>| {
            let touches = match event {
                // Reading is no change, or looking at a file would be a reason to look again.
                Ok(event) => match event.kind {
                    EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
                    EventKind::Access(_) => false,
                    _ => true,
                },
                // Events may have been lost: look.
                Err(_) => true,
            };
            if touches {
                // Nobody is left to be told when the engine is gone.
                let _ = sender.send(Message::Touched(Instant::now()));
            }
        };
        // Links are followed by whoever says what to watch: here, those that lead round in a circle would be, too.
        let watcher = RecommendedWatcher::new(handler, Config::default().with_follow_symlinks(false));
        let watcher = watcher.map_err(|error| WatchError { reason: error.to_string() })?;
        Ok(Self { watcher, watched: BTreeMap::new() })
    }

    /// Watches these places from now on, and nothing else; a folder that was made anew is watched anew.
    pub fn watch(&mut self, places: impl IntoIterator<Item = Place>) -> Watched {
        let wanted = distinct(places);
        for folder in self.watched.keys().filter(|folder| self.watched.get(*folder) != wanted.get(*folder)) {
            // A folder that is gone has no watch left to take back.
            let _ = self.watcher.unwatch(folder);
        }
        let mut watched = BTreeMap::new();
        for (folder, below) in &wanted {
            let mode = if *below { RecursiveMode::Recursive } else { RecursiveMode::NonRecursive };
            // What names a folder that does not exist fails to load, and that is told.
            if self.watcher.watch(folder, mode).is_ok() {
                watched.insert(folder.clone(), *below);
            }
        }
        let all = watched.len() == wanted.len();
        let more = watched.iter().any(|(folder, below)| self.watched.get(folder) != Some(below));
        self.watched = watched;
        Watched { all, more }
    }
}

/// Each real folder once, and none below one that is watched with those below it.
fn distinct(places: impl IntoIterator<Item = Place>) -> BTreeMap<PathBuf, bool> {
    let mut wanted: BTreeMap<PathBuf, bool> = BTreeMap::new();
    for Place { folder, below } in places {
        let absolute = || std::path::absolute(&folder).unwrap_or_else(|_| folder.clone());
        *wanted.entry(folder.canonicalize().unwrap_or_else(|_| absolute())).or_default() |= below;
    }
    let whole: Vec<PathBuf> = wanted.iter().filter(|(_, below)| **below).map(|(folder, _)| folder.clone()).collect();
    wanted.retain(|folder, _| !whole.iter().any(|above| folder != above && folder.starts_with(above)));
    wanted
}
