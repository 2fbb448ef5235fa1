//! How far all members are, for the threads that render them.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::app::shared::compiling::watch_compiling;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::progress::{Goal, Meter};

/// Progress over all, and signals.
pub struct Watcher {
    pub interrupt: Interrupt,
    meter: Mutex<Meter>,
    /// Members, or rounds, that are done: counted where samples can't be known before.
    counted: Option<AtomicU64>,
}

impl Watcher {
    /// `counted`: the goal's samples are members, or rounds.
    pub fn new(name: &str, goal: Goal, counted: bool, interrupt: Interrupt, quiet: bool) -> Self {
        Self { interrupt, meter: Mutex::new(Meter::new(name, goal, quiet)), counted: counted.then(AtomicU64::default) }
    }

    /// A member begins: `3 of 18`.
    pub fn begin(&self, name: &str, number: usize, of: usize) {
        self.lock().rename(&format!("{name} ({number} of {of})"));
    }

    /// What an engine is to call while it compiles.
    pub fn compiling(&self) -> impl Fn(bool) + Send + Sync + use<> {
        let show = self.lock().show_compiling();
        watch_compiling(show)
    }

    /// Samples of a step.
    pub fn advance(&self, samples: u64, spp: u32) {
        if self.counted.is_none() {
            self.lock().advance(samples, spp);
        }
    }

    /// A member is done, or won't be.
    pub fn end(&self) {
        if let Some(counted) = &self.counted {
            let done = counted.fetch_add(1, Ordering::Relaxed) + 1;
            self.lock().show(done, &format!("{done} done"));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.lock().finish();
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Meter> {
        self.meter.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
