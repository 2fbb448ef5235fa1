//! How the film in a window comes along: its progress, its pace, and the time that a frame has for it.

use std::time::{Duration, Instant};

use super::pace::{self, Pace};
use crate::engine::Progress;

/// A film that is moved on before each of its pixels has a sample gets so much time for it.
const FIRST_SAMPLE: Duration = Duration::from_millis(100);

/// The film as it is traced.
pub struct Tracing {
    pub pace: Pace,
    /// Of the last step; none before the first.
    pub progress: Option<Progress>,
    /// When the film was last made to start anew.
    pub began: Instant,
    /// What a frame takes besides tracing, a running mean.
    drawing: Duration,
}

impl Tracing {
    /// Nothing is traced yet. `most_pixels` is what the device has room for.
    pub fn new(most_pixels: u64, now: Instant) -> Self {
        Self { pace: Pace::new(most_pixels), progress: None, began: now, drawing: Duration::ZERO }
    }

    /// Whether each pixel has a sample.
    pub fn is_whole(&self) -> bool {
        self.progress.is_some_and(|progress| progress.spp >= 1)
    }

    /// Whether the film may start anew: one that does so before it shows anything never shows anything.
    pub fn may_restart(&self, now: Instant) -> bool {
        self.progress.is_none() || self.is_whole() || now.duration_since(self.began) > FIRST_SAMPLE
    }

    /// Time for tracing in the next frame; `software` is whether the device is the processor.
    pub fn budget(&self, software: bool) -> Duration {
        match self.pace.settles_at() {
            Some(_) => pace::MOVING_SAMPLE,
            // A graphics card draws in no time; what a frame takes beyond that is waiting for the display.
            None if !software => pace::STEP,
            None => pace::still_step(self.drawing),
        }
    }

    /// Learns from a step that began at `begin` and traced for some seconds.
    pub fn learn(&mut self, progress: Progress, begin: Instant, seconds: f64) {
        if self.progress.is_some_and(|before| progress.spp < before.spp) {
            self.began = begin;
        }
        self.pace.learn(progress.samples, seconds);
        self.progress = Some(progress);
    }

    /// Learns what a frame took besides tracing.
    pub fn learn_drawing(&mut self, took: Duration) {
        self.drawing = (self.drawing * 3 + took) / 4;
    }
}
