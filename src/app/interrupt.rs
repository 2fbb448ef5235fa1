//! Ctrl-C, and requests to end: the first asks for what there is, the second ends the process. While there is nothing to
//! keep, the first ends it too, also where a driver compiles without end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::{Exit, output};

/// What is left to those who can end by themselves.
const GRACE: Duration = Duration::from_millis(600);

/// Set by the first signal.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    asked: Arc<AtomicBool>,
    keeps: Arc<AtomicBool>,
}

impl Interrupt {
    /// Takes over the process's signals. Where that fails, Ctrl-C just ends the process.
    pub fn listen() -> Self {
        let interrupt = Self::listen_without_keeping(Exit::Interrupted, None);
        interrupt.keep();
        interrupt
    }

    /// The same while there is nothing to keep yet: a process that has not ended a moment after the first signal ends with
    /// `interrupted`, and says why.
    pub fn listen_without_keeping(interrupted: Exit, why: Option<&'static str>) -> Self {
        let interrupt = Self::default();
        let Self { asked, keeps } = interrupt.clone();
        let _ = ctrlc::set_handler(move || {
            if asked.swap(true, Ordering::SeqCst) {
                std::process::exit(i32::from(Exit::Interrupted.code()));
            }
            let keeps = keeps.clone();
            std::thread::spawn(move || {
                std::thread::sleep(GRACE);
                if !keeps.load(Ordering::SeqCst) {
                    why.into_iter().for_each(output::note);
                    std::process::exit(i32::from(interrupted.code()));
                }
            });
        });
        interrupt
    }

    /// From now on there is something that is worth writing before the process ends.
    pub fn keep(&self) {
        self.keeps.store(true, Ordering::SeqCst);
    }

    /// What the first signal sets.
    pub fn flag(&self) -> Arc<AtomicBool> {
        self.asked.clone()
    }

    /// Whether a signal has come.
    pub fn asked(&self) -> bool {
        self.asked.load(Ordering::SeqCst)
    }
}
