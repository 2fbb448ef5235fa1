//! Compiling what was saved, beside the worker: a driver can't be told to stop, so one that takes long is left to itself, and
//! what it makes is dropped, as soon as something newer is saved.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use super::event::Problem;
use super::message::{Message, News, Outcome, Saved, Side};
use crate::gpu::{Code, Compiler};
use crate::scene::Loaded;
use crate::shader::{Library, ShaderError};

/// Compiles that may run at once, those that nobody waits for any more included: each takes a core and memory.
const MOST: usize = 3;

/// A compile that takes longer than this is told.
const LATE: Duration = Duration::from_secs(2);

/// And again after each of these.
const AGAIN: Duration = Duration::from_secs(5);

/// What is being compiled.
struct Pending {
    saved: Instant,
    begin: Instant,
    files: Vec<PathBuf>,
    edited: BTreeSet<String>,
    /// The scene of the same burst, to be taken up together with the code.
    scene: Option<Side<Box<Loaded>>>,
    /// That scene is to be drawn with this code alone.
    tied: bool,
    /// The code is not what the files hold.
    again: bool,
    warnings: Vec<Problem>,
    /// When it is told next that it takes long.
    tell: Instant,
    /// The code, while it waits for others to end.
    waits: Option<Library>,
}

/// The compiles of one worker.
pub struct Compiles {
    compiler: Compiler,
    sender: Sender<Message>,
    /// Of the newest save; results of others are dropped.
    serial: u64,
    running: usize,
    pending: Option<Pending>,
}

impl Compiles {
    pub fn new(compiler: Compiler, sender: Sender<Message>) -> Self {
        Self { compiler, sender, serial: 0, running: 0, pending: None }
    }

    /// Compiles a save. What is still being compiled is older, and given up; its files are told with the new ones.
    /// `tied`: code and scene are of each other.
    pub fn begin(
        &mut self,
        saved: Instant,
        files: Vec<PathBuf>,
        code: Saved,
        scene: Option<Side<Box<Loaded>>>,
        tied: bool,
    ) {
        let Saved { library, mut edited, again } = code;
        let now = Instant::now();
        let mut pending = Pending {
            saved,
            begin: now,
            files,
            edited: BTreeSet::new(),
            scene,
            tied,
            again,
            warnings: Vec::new(),
            tell: now + LATE,
            waits: None,
        };
        if let Some(older) = self.give_up() {
            pending.files = joined(older.files, pending.files);
            pending.scene = newer(older.scene, pending.scene);
            edited.extend(older.edited);
        }
        pending.edited = edited;
        pending.waits = Some(library);
        self.pending = Some(pending);
        self.start();
    }

    /// Whether something is being compiled that is wanted.
    pub fn is_pending(&self) -> bool {
        self.pending.is_some()
    }

    /// Drops what is being compiled, and returns it.
    fn give_up(&mut self) -> Option<Pending> {
        self.serial += 1;
        self.pending.take()
    }

    /// A look found code that can't be compiled: with it goes what was to be compiled before.
    pub fn refuse(
        &mut self,
        files: Vec<PathBuf>,
        scene: Option<Side<Box<Loaded>>>,
    ) -> (Vec<PathBuf>, Option<Side<Box<Loaded>>>) {
        match self.give_up() {
            Some(older) => (joined(older.files, files), newer(older.scene, scene)),
            None => (files, scene),
        }
    }

    /// A scene that was saved meanwhile need not wait: it comes with what the burst before it held.
    pub fn with_older_scene(&mut self, scene: Side<Box<Loaded>>) -> Side<Box<Loaded>> {
        let older = self.pending.as_mut().and_then(|pending| pending.scene.take());
        newer(older, Some(scene)).expect("invariant: there is a scene")
    }

    /// Starts a thread for what waits for one, if there may be another.
    fn start(&mut self) {
        let Some(pending) = self.pending.as_mut().filter(|_| self.running < MOST) else { return };
        let Some(library) = pending.waits.take() else { return };
        self.running += 1;
        let (compiler, sender, serial, edited) =
            (self.compiler.clone(), self.sender.clone(), self.serial, pending.edited.clone());
        // Nobody joins it: it may never end.
        std::thread::spawn(move || {
            let warn = |warning: ShaderError| {
                let _ = sender.send(Message::Warned { serial, warning: warning.into() });
            };
            let result = compiler.remake(library, &edited, &warn).map_err(|error| vec![Problem::from(error)]);
            // A worker that is gone wants nothing any more.
            let _ = sender.send(Message::Compiled { serial, result });
        });
    }

    /// A compile has ended. What is to be taken up of it, if it is that of the newest save.
    pub fn end(&mut self, serial: u64, result: Result<Code, Vec<Problem>>) -> Option<Outcome> {
        self.running -= 1;
        if serial != self.serial || self.pending.as_ref().is_none_or(|pending| pending.waits.is_some()) {
            self.start();
            return None;
        }
        let Pending { saved, files, scene, tied, again, warnings, .. } = self.pending.take()?;
        // A scene whose code is wrong waits until that is mended.
        let scene = scene.filter(|_| !tied || result.is_ok());
        Some(Outcome { saved, code: Some((files, result)), scene, warnings, tied, again })
    }

    /// Keeps a warning of the newest save, once: several passes hold the same code.
    pub fn warn(&mut self, serial: u64, warning: Problem) {
        let pending = self.pending.as_mut().filter(|_| serial == self.serial);
        let same = |known: &Problem| {
            (&known.file, known.line, &known.message) == (&warning.file, warning.line, &warning.message)
        };
        if let Some(pending) = pending.filter(|pending| !pending.warnings.iter().any(same)) {
            pending.warnings.push(warning);
        }
    }

    /// When there is something to tell of it.
    pub fn next_telling(&self) -> Option<Instant> {
        self.pending.as_ref().map(|pending| pending.tell)
    }

    /// What there is to tell now.
    pub fn tell(&mut self) -> Option<News> {
        let now = Instant::now();
        let pending = self.pending.as_mut().filter(|pending| pending.tell <= now)?;
        pending.tell = now + AGAIN;
        let given_up = self.running - usize::from(pending.waits.is_none());
        Some(News::Compiling {
            files: pending.files.clone(),
            since: pending.begin.elapsed(),
            given_up,
            warnings: pending.warnings.clone(),
        })
    }
}

/// Each file once.
fn joined(mut files: Vec<PathBuf>, more: Vec<PathBuf>) -> Vec<PathBuf> {
    files.extend(more);
    files.sort();
    files.dedup();
    files
}

/// The newer of two scenes, if there is one, with the files of both.
fn newer(older: Option<Side<Box<Loaded>>>, newer: Option<Side<Box<Loaded>>>) -> Option<Side<Box<Loaded>>> {
    match (older, newer) {
        (Some((older, _)), Some((files, result))) => Some((joined(older, files), result)),
        (older, newer) => newer.or(older),
    }
}
