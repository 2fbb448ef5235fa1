//! What ends judging from outside, and what lets it rest: the time, and a user.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::error::JudgeError;
use super::pause::Pause;

/// By which others stop judging, or let it rest.
#[derive(Clone, Default)]
pub struct Control {
    /// Judging gives up.
    pub stop: Arc<AtomicBool>,
    pub pause: Arc<Pause>,
}

impl From<Arc<AtomicBool>> for Control {
    /// One that is stopped, and never rests.
    fn from(stop: Arc<AtomicBool>) -> Self {
        Self { stop, ..Self::default() }
    }
}

/// Runs from the start of all that a user waits for, and stands while judging rests.
#[derive(Clone)]
pub struct Clock {
    begin: Instant,
    /// None where it is without end.
    seconds: Option<f64>,
    control: Control,
}

impl Clock {
    pub fn new(begin: Instant, seconds: Option<f64>, control: Control) -> Self {
        Self { begin, seconds, control }
    }

    /// Seconds since the beginning, without those of rest.
    pub fn elapsed(&self) -> f64 {
        self.begin.elapsed().saturating_sub(self.control.pause.rested()).as_secs_f64()
    }

    /// Until the end; `None` where there is none.
    pub fn left(&self) -> Option<f64> {
        self.seconds.map(|seconds| (seconds - self.elapsed()).max(0.0))
    }

    /// Waits while judging rests. Whether the time is over then; an error where a user gave up.
    pub fn is_over(&self) -> Result<bool, JudgeError> {
        self.control.pause.wait();
        if self.control.stop.load(Ordering::Relaxed) {
            return Err(JudgeError::Stopped);
        }
        Ok(self.left() == Some(0.0))
    }
}
