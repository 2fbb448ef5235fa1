//! What the threads of a watch say to each other.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::event::Problem;
use crate::gpu::Code;
use crate::scene::Loaded;
use crate::shader::Library;

/// What the worker is told.
pub enum Message {
    /// Something in a watched folder was touched.
    Touched(Instant),
    /// Everything is to be read again.
    Force,
    /// The scene is to be read again, at once: another one is wanted.
    Choose,
    /// Shaders that ran before are to run again, whatever the files hold.
    Again(Saved),
    /// The last that was taken up together, shaders and scene, is not what runs.
    Undone,
    /// A compile has ended: its number, and what it made.
    Compiled {
        serial: u64,
        result: Result<Code, Vec<Problem>>,
    },
    /// What the compile of a number found that will take long.
    Warned {
        serial: u64,
        warning: Problem,
    },
    Stop,
}

/// Shaders to be compiled, and the names of the modules that are other ones.
pub struct Saved {
    pub library: Library,
    pub edited: BTreeSet<String>,
    /// They ran before, and are not what the files hold.
    pub again: bool,
}

/// What a look at some files gives.
pub enum Look<T> {
    Same,
    /// A file is empty, gone or cut short: most likely it is being saved.
    Unfinished,
    Changed {
        files: Vec<PathBuf>,
        result: Result<T, Vec<Problem>>,
    },
}

impl<T> Look<T> {
    pub fn changed(self) -> Option<Side<T>> {
        match self {
            Look::Changed { files, result } => Some((files, result)),
            Look::Same | Look::Unfinished => None,
        }
    }
}

/// What the worker sends.
pub enum News {
    Ready(Box<Outcome>),
    /// A compile takes long.
    Compiling {
        files: Vec<PathBuf>,
        since: Duration,
        /// Older compiles that have not ended yet.
        given_up: usize,
        warnings: Vec<Problem>,
    },
}

/// What came of a burst of saves.
pub struct Outcome {
    /// When the first file of it was touched.
    pub saved: Instant,
    pub code: Option<Side<Code>>,
    pub scene: Option<Side<Box<Loaded>>>,
    /// Of good code.
    pub warnings: Vec<Problem>,
    /// Code and scene are of each other: neither is to run without the other.
    pub tied: bool,
    /// The code ran before, and is not what the files hold.
    pub again: bool,
}

/// The files that changed of shaders, or of the scene, and what they give.
pub type Side<T> = (Vec<PathBuf>, Result<T, Vec<Problem>>);
