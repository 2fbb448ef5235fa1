//! What people save while the engine runs, taken up as transactions.
//!
//! A [`worker`] thread waits for the [`watcher`] and reads what changed; threads that nobody joins link, validate and compile it
//! ([`compile`]); the picture goes on meanwhile. At the start of the schedule [`take_up`] puts what came of it in place, all or nothing; the phases after it
//! find out what that changes, as after any edit. The last that worked is kept until the new has shown one whole sample: an
//! error on the way, or a loop that does not end, brings it back, with the film it had.

mod assets;
mod compile;
mod event;
mod lint;
mod shaders;
mod take_up;
mod watcher;
mod worker;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Instant;

use bevy_ecs::prelude::*;

pub use assets::{Adjust, SceneFile};
pub use event::{Problem, ReloadEvent, Restarts};
pub use watcher::WatchError;

pub(super) use take_up::{add_systems, go_back};

use super::state::FilmProgress;
use crate::gpu::{Code, Compiler};
use crate::scene::SceneDescription;
use crate::shader::Library;
use assets::SceneFiles;
use compile::Compiles;
use lint::{Linter, Wake};
use shaders::ShaderFolder;
use watcher::Folders;
use worker::{Message, News, Worker};

/// What to watch, and what of it runs already.
pub struct Sources {
    /// The folder that the engine's library was read from.
    pub shaders: Option<(PathBuf, Library)>,
    /// The scene file, what it gave, and the files it was read from.
    pub scene: Option<(SceneFile, SceneDescription, Vec<PathBuf>)>,
}

/// The state of watching.
#[derive(Resource)]
pub struct Reload {
    sender: Sender<Message>,
    outcomes: Mutex<Receiver<News>>,
    worker: Option<JoinHandle<()>>,
    /// The scene as its files were last taken up.
    pub description: Option<SceneDescription>,
    /// What is wrong with shaders and scene as they are on the disk; the engine runs older ones.
    pub problems: Standing,
    /// Not yet asked for.
    pub events: Vec<ReloadEvent>,
    /// What was taken up in this run of the schedule.
    taken: Vec<Taken>,
    /// What could not be taken up in it: told after what was.
    refused: Vec<ReloadEvent>,
    /// The scene, or the code, had to give way to an older one, and is tried again when the other changes.
    retry_scene: bool,
    retry_code: bool,
    /// An outcome waits to be taken up.
    waits: Arc<AtomicBool>,
    /// When the save happened whose first pixels are not there yet.
    awaited: Option<Instant>,
    /// What other code makes anew, from when it is put in place until the changes of the scene are known.
    code_restarts: Restarts,
    trial: Trial,
    linter: Linter,
}

/// Problems by what they are about.
#[derive(Default)]
pub struct Standing {
    pub code: Vec<Problem>,
    pub scene: Vec<Problem>,
}

/// Something good that was put in place.
struct Taken {
    saved: Instant,
    files: Vec<PathBuf>,
    warnings: Vec<Problem>,
}

/// What to go back to.
#[derive(Default)]
struct Trial {
    code: Option<Code>,
    /// The code that runs now has shown a whole sample.
    passed: bool,
    /// What the code on trial makes anew.
    restarts: Restarts,
    scene: Option<SceneDescription>,
    /// How far the film was that was put aside.
    film: Option<FilmProgress>,
    /// The files that are on trial.
    files: Vec<PathBuf>,
}

impl Reload {
    /// Starts to watch. `wake` is called, from another thread, when the next step has something to take up.
    pub fn start(sources: Sources, compiler: Compiler, wake: Wake) -> Result<Reload, WatchError> {
        let (sender, messages) = channel();
        let (outcome_sender, outcomes) = channel();
        let folders = Folders::new(sender.clone())?;
        let linter = Linter::new(sources.shaders.as_ref().map(|(_, library)| library.clone()), wake.clone());
        let compiles = Compiles::new(compiler, sender.clone());
        let shaders = sources.shaders.map(|(folder, library)| (ShaderFolder::new(folder, &library), compiles));
        let (scene, description) = match sources.scene {
            Some((file, description, files)) => (Some(SceneFiles::new(file, &files)), Some(description)),
            None => (None, None),
        };
        let waits = Arc::new(AtomicBool::new(false));
        let worker = Worker {
            folders,
            shaders,
            scene,
            messages,
            outcomes: outcome_sender,
            wake: Box::new(move || wake()),
            waits: waits.clone(),
        };
        let worker = std::thread::spawn(move || worker.run());
        Ok(Reload {
            sender,
            outcomes: Mutex::new(outcomes),
            worker: Some(worker),
            description,
            problems: Standing::default(),
            events: Vec::new(),
            taken: Vec::new(),
            refused: Vec::new(),
            retry_scene: false,
            retry_code: false,
            waits,
            awaited: None,
            code_restarts: Restarts::default(),
            trial: Trial::default(),
            linter,
        })
    }

    /// Whether the next step has something to take up.
    pub fn waits(&self) -> bool {
        self.waits.load(Ordering::Acquire)
    }

    /// Has everything read again, changed or not.
    pub fn force(&self) {
        // A worker that is gone has told why when it went.
        let _ = self.sender.send(Message::Force);
    }
}

impl Drop for Reload {
    fn drop(&mut self) {
        let _ = self.sender.send(Message::Stop);
        if let Some(worker) = self.worker.take() {
            let _ = worker.join();
        }
    }
}
