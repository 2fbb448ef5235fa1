//! What ends judging from outside: the time, and a user.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::error::JudgeError;

/// Runs from the start of all that a user waits for.
#[derive(Clone)]
pub struct Clock {
    begin: Instant,
    /// Wall clock; none where it is without end.
    seconds: Option<f64>,
    stop: Arc<AtomicBool>,
}

impl Clock {
    pub fn new(begin: Instant, seconds: Option<f64>, stop: Arc<AtomicBool>) -> Self {
        Self { begin, seconds, stop }
    }

    /// Since the beginning.
    pub fn elapsed(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    /// Until the end; `None` where there is none.
    pub fn left(&self) -> Option<f64> {
        self.seconds.map(|seconds| (seconds - self.elapsed()).max(0.0))
    }

    /// Whether the time is over; an error where a user gave up.
    pub fn is_over(&self) -> Result<bool, JudgeError> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(JudgeError::Stopped);
        }
        Ok(self.left() == Some(0.0))
    }
}
