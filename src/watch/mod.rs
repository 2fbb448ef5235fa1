//! Files that are saved while the engine runs: what changed is read, linked and compiled beside it.
//!
//! A [`worker`] thread waits for the [`watcher`] and reads what changed; threads that nobody joins link, validate and compile it
//! ([`compile`]); the picture goes on meanwhile. What came of it is [`News`], which the engine puts in place, all or nothing
//! (`systems/reload/`).

mod assets;
mod compile;
mod event;
pub mod lint;
mod linter;
mod message;
mod shaders;
pub mod values;
mod watcher;
mod worker;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

pub use assets::{Adjust, Attempt, Read, WatchedScene};
pub use event::{Problem, ReloadEvent, Restarts};
pub use linter::{Linter, Wake, lint_edit};
pub use message::{News, Outcome};
pub use watcher::WatchError;

use crate::gpu::Compiler;
use crate::scene::{SceneDescription, SceneText};
use crate::shader::{Layers, Library};
use assets::SceneFiles;
use compile::Compiles;
use message::{Message, Saved};
use shaders::ShaderFolders;
use watcher::Folders;
use worker::Worker;

/// What to watch, and what of it runs already.
pub struct Sources {
    /// What the engine's library was read from.
    pub shaders: Option<(Layers, Library)>,
    pub scene: Option<SceneSource>,
}

/// The scene that runs already, and how it is read again.
pub struct SceneSource {
    pub watched: WatchedScene,
    pub description: SceneDescription,
    /// Its own file's, as it was read for that.
    pub text: SceneText,
    /// The files it was read from.
    pub files: Vec<PathBuf>,
}

/// A worker that watches, as long as this lives.
pub struct Watch {
    sender: Sender<Message>,
    news: Mutex<Receiver<News>>,
    worker: Option<JoinHandle<()>>,
    /// There is news.
    waits: Arc<AtomicBool>,
    /// Something is being compiled.
    compiles: Arc<AtomicBool>,
}

impl Watch {
    /// Starts to watch. `wake` is called, from another thread, when there is news.
    pub fn start(sources: Sources, compiler: Compiler, wake: Wake) -> Result<Watch, WatchError> {
        let (sender, messages) = channel();
        let (news_sender, news) = channel();
        let folders = Folders::new(sender.clone())?;
        let compiles = Compiles::new(compiler, sender.clone());
        let (waits, busy) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let worker = Worker {
            folders,
            shaders: sources.shaders.map(|(layers, library)| (ShaderFolders::new(layers, &library), compiles)),
            scene: sources.scene.map(|scene| SceneFiles::new(scene.watched, &scene.files)),
            messages,
            news: news_sender,
            wake: Box::new(move || wake()),
            waits: waits.clone(),
            compiles: busy.clone(),
            apart: false,
        };
        let worker = std::thread::spawn(move || worker.run());
        Ok(Watch { sender, news: Mutex::new(news), worker: Some(worker), waits, compiles: busy })
    }

    /// Whether there is news.
    pub fn waits(&self) -> bool {
        self.waits.load(Ordering::Acquire)
    }

    /// What came since the last call.
    pub fn news(&mut self) -> Vec<News> {
        self.waits.store(false, Ordering::Release);
        self.news.get_mut().unwrap_or_else(PoisonError::into_inner).try_iter().collect()
    }

    /// Has everything read again, changed or not.
    pub fn force(&self) {
        // A worker that is gone has told why when it went.
        let _ = self.sender.send(Message::Force);
    }

    /// Has the scene read again, at once: another one is wanted.
    pub fn choose(&self) {
        let _ = self.sender.send(Message::Choose);
    }

    /// Whether something is being compiled.
    pub fn compiles(&self) -> bool {
        self.compiles.load(Ordering::Acquire)
    }

    /// Has shaders that ran before run again, whatever the files hold. `edited` are the modules that they have otherwise than those which run.
    pub fn run_again(&self, library: Library, edited: BTreeSet<String>) {
        let _ = self.sender.send(Message::Again(Saved { library, edited, again: true }));
    }

    /// Says that what was taken up together last, shaders and scene, was taken back.
    pub fn undone(&self) {
        let _ = self.sender.send(Message::Undone);
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.sender.send(Message::Stop);
        if let Some(worker) = self.worker.take() {
            let _ = worker.join();
        }
    }
}
