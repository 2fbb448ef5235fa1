//! How far all members are, for the threads that render them.

use std::sync::{Mutex, PoisonError};

use crate::app::shared::compiling::watch_compiling;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::progress::{Goal, Meter};

/// Progress over all, and signals.
pub struct Watcher {
    pub interrupt: Interrupt,
    meter: Mutex<Meter>,
    /// Members that are counted, where samples can't be known before.
    counted: bool,
}

impl Watcher {
    /// `counted`: the goal's samples are members.
    pub fn new(name: &str, goal: Goal, counted: bool, interrupt: Interrupt, quiet: bool) -> Self {
        Self { interrupt, meter: Mutex::new(Meter::new(name, goal, quiet)), counted }
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
        let samples = if self.counted { 0 } else { samples };
        self.lock().advance(samples, spp);
    }

    /// A member is done, or won't be.
    pub fn end(&self) {
        if self.counted {
            self.lock().advance(1, 0);
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
