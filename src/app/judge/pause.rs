//! Lets judging rest for as long as somebody else needs the device.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Whether judging rests, and for how long it did.
#[derive(Default)]
pub struct Pause {
    state: Mutex<State>,
    ended: Condvar,
}

#[derive(Default)]
struct State {
    /// Since when it rests; none while it runs.
    since: Option<Instant>,
    /// All rests that are over.
    rested: Duration,
}

impl Pause {
    /// Has judging rest from the next batch on, or go on.
    pub fn set(&self, on: bool) {
        let mut state = self.lock();
        match (on, state.since) {
            (true, None) => state.since = Some(Instant::now()),
            (false, Some(since)) => {
                state.rested += since.elapsed();
                state.since = None;
                self.ended.notify_all();
            }
            _ => {}
        }
    }

    /// Waits until judging may go on.
    pub fn wait(&self) {
        let state = self.lock();
        drop(self.ended.wait_while(state, |state| state.since.is_some()).unwrap_or_else(PoisonError::into_inner));
    }

    /// How long it rested by now.
    pub fn rested(&self) -> Duration {
        let state = self.lock();
        state.rested + state.since.map_or(Duration::ZERO, |since| since.elapsed())
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
