//! Folders under watch. A message says only that something was touched: what changed is told by contents.
//!
//! Folders, not files: editors save by writing another file and renaming it, and a watch follows the old one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;
use std::time::Instant;

use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{RecommendedWatcher, RecursiveMode, Watcher};

use super::worker::Message;

/// Why nothing can be watched.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("files can't be watched: {reason}")]
#[diagnostic(help("on Linux, the limits fs.inotify.max_user_watches and max_user_instances may be too low"))]
pub struct WatchError {
    reason: String,
}

/// Sends a message for whatever happens in some folders.
pub struct Folders {
    watcher: RecommendedWatcher,
    watched: BTreeSet<(PathBuf, bool)>,
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
        let watcher = notify::recommended_watcher(handler).map_err(|error| WatchError { reason: error.to_string() })?;
        Ok(Self { watcher, watched: BTreeSet::new() })
    }

    /// Watches these folders from now on, each with or without those below it; one that was made anew is watched anew.
    /// Whether all of them are: one that does not exist can't be, and this is to be called again once it may.
    pub fn watch(&mut self, wanted: impl IntoIterator<Item = (PathBuf, bool)>) -> bool {
        let wanted: BTreeSet<(PathBuf, bool)> = wanted.into_iter().collect();
        for (folder, _) in self.watched.difference(&wanted) {
            // A folder that is gone has no watch left to take back.
            let _ = self.watcher.unwatch(folder);
        }
        let mut all = true;
        for (folder, below) in &wanted {
            let mode = if *below { RecursiveMode::Recursive } else { RecursiveMode::NonRecursive };
            // What names a folder that does not exist fails to load, and that is told.
            all &= self.watcher.watch(folder, mode).is_ok();
        }
        self.watched = wanted;
        all
    }
}

/// The folder a file is in.
pub fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if folder.as_os_str().is_empty() => PathBuf::from("."),
        Some(folder) => folder.to_path_buf(),
        None => PathBuf::from("."),
    }
}
