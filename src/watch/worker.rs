//! The thread that looks at files: it waits until a burst of saves is over, reads, has others compile, and sends what came of it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use super::assets::SceneFiles;
use super::compile::Compiles;
use super::event::Problem;
use super::message::{Look, Message, News, Outcome, Saved, Side};
use super::shaders::ShaderFolders;
use super::watcher::{Folders, Place, Watched};
use crate::gpu::Code;
use crate::scene::Loaded;

/// A burst is over when nothing was touched for so long: longer than an editor or git takes from one file to the next.
const QUIET: Duration = Duration::from_millis(30);

/// But no burst is longer than this.
const LONGEST_BURST: Duration = Duration::from_millis(500);

/// A file that stays empty, cut short or away for so long is meant to be.
const PATIENCE: Duration = Duration::from_millis(500);

/// Between two looks for a folder that is not there.
const SEARCH: Duration = Duration::from_millis(500);

/// The worker's own state.
pub struct Worker {
    pub folders: Folders,
    pub shaders: Option<(ShaderFolders, Compiles)>,
    pub scene: Option<SceneFiles>,
    pub messages: Receiver<Message>,
    pub news: Sender<News>,
    /// Tells the driver that there is news.
    pub wake: Box<dyn Fn() + Send>,
    /// Set while news waits to be taken up.
    pub waits: Arc<AtomicBool>,
    /// Set while something is being compiled.
    pub compiles: Arc<AtomicBool>,
    /// Shaders and scene as they were last read are of each other, and not what runs: whatever is saved next, both are read, and taken
    /// up both or neither.
    pub apart: bool,
}

/// What is to be read again, changed or not.
#[derive(Clone, Copy, Default)]
struct Force {
    code: bool,
    scene: bool,
}

impl Worker {
    /// Works until it is told to stop, or nobody is left to tell it anything.
    pub fn run(mut self) {
        let mut all = self.watch().all;
        // What was saved between reading and watching.
        let mut next = Some(Message::Touched(Instant::now()));
        while let Some(message) = next.take().or_else(|| self.receive(all)) {
            let (saved, force) = match message {
                Message::Touched(saved) => (saved, Force::default()),
                Message::Force => (Instant::now(), Force { code: true, scene: true }),
                Message::Choose => (Instant::now(), Force { code: false, scene: true }),
                Message::Again(saved) => {
                    self.run_again(saved);
                    continue;
                }
                Message::Undone => {
                    self.apart = true;
                    continue;
                }
                Message::Compiled { serial, result } => match self.end_compile(serial, result) {
                    true => continue,
                    false => return,
                },
                Message::Warned { serial, warning } => {
                    self.warn(serial, warning);
                    continue;
                }
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

    /// The next message. While a folder is not there to be watched, it is looked for now and then; a compile that takes long
    /// is told meanwhile.
    fn receive(&mut self, all: bool) -> Option<Message> {
        let search = Instant::now() + SEARCH;
        loop {
            let telling = self.shaders.as_ref().and_then(|(_, compiles)| compiles.next_telling());
            let until = telling.into_iter().chain((!all).then_some(search)).min();
            let Some(until) = until else { return self.messages.recv().ok() };
            match self.messages.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Err(RecvTimeoutError::Timeout) => {}
                message => return message.ok(),
            }
            if let Some(news) = self.shaders.as_mut().and_then(|(_, compiles)| compiles.tell())
                && !self.send(news)
            {
                return None;
            }
            if !all && search <= Instant::now() {
                return Some(Message::Touched(Instant::now()));
            }
        }
    }

    /// Takes what a compile has made. False if nobody takes it.
    fn end_compile(&mut self, serial: u64, result: Result<Code, Vec<Problem>>) -> bool {
        let ended = self.shaders.as_mut().and_then(|(_, compiles)| compiles.end(serial, result));
        self.tell_compiling();
        ended.is_none_or(|outcome| {
            self.apart &= !outcome.tied || matches!(outcome.code, Some((_, Err(_))));
            self.send(News::Ready(Box::new(outcome)))
        })
    }

    /// Compiles shaders that ran before. What a later look finds in the files is other code than at the look before, as ever.
    fn run_again(&mut self, saved: Saved) {
        if let Some((_, compiles)) = &mut self.shaders {
            compiles.begin(Instant::now(), Vec::new(), saved, None, false);
        }
        self.tell_compiling();
    }

    /// Says whether something is being compiled; wakes the driver when that begins, for the processor is wanted then.
    fn tell_compiling(&self) {
        let pending = self.shaders.as_ref().is_some_and(|(_, compiles)| compiles.is_pending());
        if !self.compiles.swap(pending, Ordering::AcqRel) && pending {
            (self.wake)();
        }
    }

    fn warn(&mut self, serial: u64, warning: Problem) {
        if let Some((_, compiles)) = &mut self.shaders {
            compiles.warn(serial, warning);
        }
    }

    /// Sends, and wakes the driver. False if nobody takes it.
    fn send(&self, news: News) -> bool {
        // Before it is sent, or it could be taken up before it is said to wait; and behind that, for who looked in between found nothing.
        self.waits.store(true, Ordering::Release);
        let sent = self.news.send(news).is_ok();
        self.waits.store(true, Ordering::Release);
        (self.wake)();
        sent
    }

    /// Waits until a burst is over. What is to be read again; None if the worker is to stop.
    fn wait_for_quiet(&mut self, saved: Instant, force: Force) -> Option<Force> {
        let mut force = force;
        while !force.code && !force.scene && saved.elapsed() < LONGEST_BURST {
            match self.messages.recv_timeout(QUIET) {
                Ok(Message::Touched(_)) => {}
                Ok(Message::Force) => force = Force { code: true, scene: true },
                Ok(Message::Choose) => force.scene = true,
                Ok(Message::Again(saved)) => self.run_again(saved),
                Ok(Message::Undone) => self.apart = true,
                Ok(Message::Compiled { serial, result }) => {
                    if !self.end_compile(serial, result) {
                        return None;
                    }
                }
                Ok(Message::Warned { serial, warning }) => self.warn(serial, warning),
                Ok(Message::Stop) | Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) => break,
            }
        }
        Some(force)
    }

    /// Looks until no file is half saved, and sends what changed. False if nobody takes it.
    fn look(&mut self, saved: Instant, force: Force) -> bool {
        let patient = |force: bool| !force && saved.elapsed() < PATIENCE;
        let mut scene = until_whole(|| {
            let force = force.scene;
            self.scene.as_mut().map_or(Look::Same, |scene| scene.look(patient(force), force))
        });
        if let (Some(SceneFiles { shaders: Some(layers), .. }), Some((folders, _))) = (&self.scene, &mut self.shaders) {
            self.apart |= folders.choose(layers);
        }
        let force_code = force.code || self.apart && !matches!(scene, Look::Same);
        let code = until_whole(|| {
            let folders = self.shaders.as_mut();
            folders.map_or(Look::Same, |(folders, _)| folders.look(patient(force_code || force.scene), force_code))
        });
        if self.apart && matches!((&code, &scene), (Look::Changed { .. }, Look::Same)) {
            scene = self.scene.as_mut().map_or(Look::Same, |scene| scene.look(false, true));
        }
        let outcome = self.outcome(saved, code.changed(), scene.changed());
        self.tell_compiling();
        match outcome {
            Some(outcome) => self.send(News::Ready(Box::new(outcome))),
            None => true,
        }
    }

    /// What is to be sent at once of what was read; code that can be compiled is, first.
    fn outcome(
        &mut self,
        saved: Instant,
        code: Option<Side<Saved>>,
        scene: Option<Side<Box<Loaded>>>,
    ) -> Option<Outcome> {
        let tied = self.apart;
        let (warnings, none) = (Vec::new(), code.is_none() && scene.is_none());
        let Some((_, compiles)) = self.shaders.as_mut().filter(|_| !none) else {
            return scene.map(|scene| Outcome {
                saved,
                code: None,
                scene: Some(scene),
                warnings,
                tied: false,
                again: false,
            });
        };
        // Shaders of a scene that can't be read are of no use.
        let code = code.filter(|_| !tied || matches!(scene, None | Some((_, Ok(_)))));
        match code {
            Some((files, Ok(code))) => {
                compiles.begin(saved, files, code, scene, tied);
                None
            }
            Some((files, Err(problems))) => {
                let (files, scene) = compiles.refuse(files, scene);
                let scene = scene.filter(|_| !tied);
                Some(Outcome { saved, code: Some((files, Err(problems))), scene, warnings, tied, again: false })
            }
            None if tied => {
                let scene = scene.map(|(files, scene)| compiles.refuse(files, Some((Vec::new(), scene))));
                let scene = scene.and_then(|(files, scene)| Some((files, scene?.1)));
                Some(Outcome { saved, code: None, scene, warnings, tied: false, again: false })
            }
            None => {
                let scene = scene.map(|scene| compiles.with_older_scene(scene));
                Some(Outcome { saved, code: None, scene, warnings, tied: false, again: false })
            }
        }
    }

    /// Watches what is to be watched now.
    fn watch(&mut self) -> Watched {
        let shaders = self.shaders.iter().flat_map(|(folder, _)| folder.places());
        let scenes = self.scene.iter().flat_map(SceneFiles::folders).map(|folder| Place { folder, below: false });
        self.folders.watch(shaders.chain(scenes).collect::<Vec<_>>())
    }
}

/// Looks until no file is half saved.
fn until_whole<T>(mut look: impl FnMut() -> Look<T>) -> Look<T> {
    loop {
        match look() {
            Look::Unfinished => std::thread::sleep(QUIET / 2),
            found => return found,
        }
    }
}
