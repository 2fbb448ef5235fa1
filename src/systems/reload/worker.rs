//! The thread that looks at files: it waits until a burst of saves is over, reads, links and compiles, and sends what came of it.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use super::assets::SceneFiles;
use super::event::Problem;
use super::shaders::ShaderFolder;
use super::watcher::{Folders, Place, Watched};
use crate::gpu::Code;
use crate::scene::Loaded;

/// A burst is over when nothing was touched for so long: longer than an editor or git takes from one file to the next.
const QUIET: Duration = Duration::from_millis(30);

/// But no burst is longer than this.
const LONGEST_BURST: Duration = Duration::from_millis(500);

/// A file that stays empty or away for so long is meant to be.
const PATIENCE: Duration = Duration::from_millis(500);

/// Between two looks for a folder that is not there.
const SEARCH: Duration = Duration::from_millis(500);

/// What the worker is told.
pub enum Message {
    /// Something in a watched folder was touched.
    Touched(Instant),
    /// Everything is to be read again.
    Force,
    Stop,
}

/// What a look at some files gives.
pub enum Look<T> {
    Same,
    /// A file is empty or gone: most likely it is being saved.
    Unfinished,
    Changed {
        files: Vec<PathBuf>,
        result: Result<T, Vec<Problem>>,
    },
}

impl<T> Look<T> {
    fn changed(self) -> Option<Side<T>> {
        match self {
            Look::Changed { files, result } => Some((files, result)),
            Look::Same | Look::Unfinished => None,
        }
    }
}

/// What came of a burst of saves.
pub struct Outcome {
    /// When the first file of it was touched.
    pub saved: Instant,
    pub code: Option<Side<Code>>,
    pub scene: Option<Side<Box<Loaded>>>,
}

/// The files that changed of shaders, or of the scene, and what they give.
type Side<T> = (Vec<PathBuf>, Result<T, Vec<Problem>>);

/// The worker's own state.
pub struct Worker {
    pub folders: Folders,
    pub shaders: Option<ShaderFolder>,
    pub scene: Option<SceneFiles>,
    pub messages: Receiver<Message>,
    pub outcomes: Sender<Outcome>,
    /// Tells the driver that there is an outcome.
    pub wake: Box<dyn Fn() + Send>,
    /// Set while an outcome waits to be taken up.
    pub waits: Arc<AtomicBool>,
}

impl Worker {
    /// Works until it is told to stop, or nobody is left to tell it anything.
    pub fn run(mut self) {
        let mut all = self.watch().all;
        // What was saved between reading and watching.
        let mut next = Some(Message::Touched(Instant::now()));
        while let Some(message) = next.take().or_else(|| self.receive(all)) {
            let (saved, force) = match message {
                Message::Touched(saved) => (saved, false),
                Message::Force => (Instant::now(), true),
                Message::Stop => return,
            };
            let Some(force) = self.wait_for_quiet(saved, force) else { return };
            if !self.look(saved, force) {
                return;
            }
            // A folder may have been made anew, a scene may name files in others, and a link may lead elsewhere.
            let watched = self.watch();
            all = watched.all;
            if watched.more {
                // What was saved between the look and the watch.
                next = Some(Message::Touched(Instant::now()));
            }
        }
    }

    /// The next message. While a folder is not there to be watched, it is looked for now and then.
    fn receive(&self, all: bool) -> Option<Message> {
        if all {
            return self.messages.recv().ok();
        }
        match self.messages.recv_timeout(SEARCH) {
            Err(RecvTimeoutError::Timeout) => Some(Message::Touched(Instant::now())),
            message => message.ok(),
        }
    }

    /// Waits until a burst is over. Whether everything is to be read again; None if the worker is to stop.
    fn wait_for_quiet(&self, saved: Instant, force: bool) -> Option<bool> {
        let mut force = force;
        while !force && saved.elapsed() < LONGEST_BURST {
            match self.messages.recv_timeout(QUIET) {
                Ok(Message::Touched(_)) => {}
                Ok(Message::Force) => force = true,
                Ok(Message::Stop) | Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) => break,
            }
        }
        Some(force)
    }

    /// Looks until no file is half saved, and sends what changed. False if nobody takes it.
    fn look(&mut self, saved: Instant, force: bool) -> bool {
        let (mut code, mut scene) = (Look::Unfinished, Look::Unfinished);
        loop {
            let patient = !force && saved.elapsed() < PATIENCE;
            if matches!(code, Look::Unfinished) {
                code = self.shaders.as_mut().map_or(Look::Same, |shaders| shaders.look(patient, force));
            }
            if matches!(scene, Look::Unfinished) {
                scene = self.scene.as_mut().map_or(Look::Same, |scene| scene.look(patient, force));
            }
            if !matches!(code, Look::Unfinished) && !matches!(scene, Look::Unfinished) {
                break;
            }
            std::thread::sleep(QUIET / 2);
        }
        let outcome = Outcome { saved, code: code.changed(), scene: scene.changed() };
        if outcome.code.is_none() && outcome.scene.is_none() {
            return true;
        }
        // Before it is sent, or it could be taken up before it is said to wait.
        self.waits.store(true, Ordering::Release);
        let sent = self.outcomes.send(outcome).is_ok();
        (self.wake)();
        sent
    }

    /// Watches what is to be watched now.
    fn watch(&mut self) -> Watched {
        let shaders = self.shaders.iter().flat_map(ShaderFolder::places);
        let scenes = self.scene.iter().flat_map(SceneFiles::folders).map(|folder| Place { folder, below: false });
        self.folders.watch(shaders.chain(scenes).collect::<Vec<_>>())
    }
}
