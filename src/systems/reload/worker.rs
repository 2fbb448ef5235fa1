//! The thread that looks at files: it waits until a burst of saves is over, reads, links and compiles, and sends what came of it.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use super::assets::SceneFiles;
use super::event::Problem;
use super::shaders::ShaderFolder;
use super::watcher::Folders;
use crate::gpu::Code;
use crate::scene::Loaded;

/// A burst is over when nothing was touched for so long: longer than an editor or git takes from one file to the next.
const QUIET: Duration = Duration::from_millis(30);

/// But no burst is longer than this.
const LONGEST_BURST: Duration = Duration::from_millis(500);

/// A file that stays empty or away for so long is meant to be.
const PATIENCE: Duration = Duration::from_millis(500);

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

/// What came of a burst of saves.
pub struct Outcome {
    /// When the first file of it was touched.
    pub saved: Instant,
    pub files: Vec<PathBuf>,
    pub code: Option<Result<Code, Vec<Problem>>>,
    pub scene: Option<Result<Box<Loaded>, Vec<Problem>>>,
}

/// The worker's own state.
pub struct Worker {
    pub folders: Folders,
    pub shaders: Option<ShaderFolder>,
    pub scene: Option<SceneFiles>,
    pub messages: Receiver<Message>,
    pub outcomes: Sender<Outcome>,
    /// Tells the driver that there is an outcome.
    pub wake: Box<dyn Fn() + Send>,
}

impl Worker {
    /// Works until it is told to stop, or nobody is left to tell it anything.
    pub fn run(mut self) {
        self.watch();
        // What was saved between reading and watching.
        let mut next = Some(Message::Touched(Instant::now()));
        while let Some(message) = next.take().or_else(|| self.messages.recv().ok()) {
            let (saved, force) = match message {
                Message::Touched(saved) => (saved, false),
                Message::Force => (Instant::now(), true),
                Message::Stop => return,
            };
            let Some(force) = self.wait_for_quiet(saved, force) else { return };
            if !self.look(saved, force) {
                return;
            }
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
        // A folder may have been made anew, and a scene may name files in others.
        self.watch();
        let mut outcome = Outcome { saved, files: Vec::new(), code: None, scene: None };
        if let Look::Changed { files, result } = code {
            outcome.files.extend(files);
            outcome.code = Some(result);
        }
        if let Look::Changed { files, result } = scene {
            outcome.files.extend(files);
            outcome.scene = Some(result);
        }
        if outcome.code.is_none() && outcome.scene.is_none() {
            return true;
        }
        let sent = self.outcomes.send(outcome).is_ok();
        (self.wake)();
        sent
    }

    fn watch(&mut self) {
        let shaders = self.shaders.iter().map(|shaders| (shaders.folder().to_path_buf(), true));
        let scenes = self.scene.iter().flat_map(SceneFiles::folders).map(|folder| (folder, false));
        self.folders.watch(shaders.chain(scenes).collect::<Vec<_>>());
    }
}
