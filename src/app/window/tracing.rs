//! How the film in a window comes along: its progress, its pace, and the time that a frame has for it.

use std::time::{Duration, Instant};

use super::pace::{self, Pace};
use crate::engine::Progress;

/// Samples a pixel at which the picture's error is first looked at, and then at each double of them: to look takes a moment.
const FIRST_LOOK: u32 = 64;

/// Codes of 8 bits: the error, root mean square, that rounding to them makes anyway.
const ROUNDING: f64 = 0.289;

/// Why a film gets no more samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rest {
    /// The user wants it so.
    Paused,
    /// More would not be seen.
    Fine,
}

/// The film as it is traced.
pub struct Tracing {
    pub pace: Pace,
    /// Of the last step; none before the first.
    pub progress: Option<Progress>,
    /// When the film was last made to start anew.
    pub began: Instant,
    /// None while it gets more samples.
    pub rest: Option<Rest>,
    next_look: u32,
    /// What a frame takes besides tracing, a running mean.
    drawing: Duration,
}

impl Tracing {
    /// Nothing is traced yet. `most_pixels` is what the device has room for.
    pub fn new(most_pixels: u64, now: Instant) -> Self {
        Self {
            pace: Pace::new(most_pixels),
            progress: None,
            began: now,
            rest: None,
            next_look: FIRST_LOOK,
            drawing: Duration::ZERO,
        }
    }

    /// Whether each pixel has a sample.
    pub fn is_whole(&self) -> bool {
        self.progress.is_some_and(|progress| progress.spp >= 1)
    }

    /// Time for tracing in the next frame; `software` is whether the device is the processor.
    pub fn budget(&self, software: bool, now: Instant) -> Duration {
        match self.pace.moves(now) {
            // A graphics card draws in no time; what a frame takes beyond that is waiting for the display.
            _ if !software => pace::STEP,
            true => pace::MOVING_STEP,
            false => pace::still_step(self.drawing),
        }
    }

    /// Learns from a step that began at `begin`.
    pub fn learn(&mut self, progress: Progress, begin: Instant) {
        if self.progress.is_some_and(|before| progress.spp < before.spp) {
            self.began = begin;
            self.look_anew();
        }
        self.progress = Some(progress);
    }

    /// The film, or the way it is shown, is another one: whether it is fine enough is open again.
    pub fn look_anew(&mut self) {
        self.next_look = FIRST_LOOK;
    }

    /// Whether it is time to look at the picture's error.
    pub fn wants_look(&self) -> bool {
        self.rest.is_none() && self.progress.is_some_and(|progress| progress.spp >= self.next_look)
    }

    /// Learns that error, in codes of 8 bits. Says whether the picture is as fine as these can be.
    pub fn learn_error(&mut self, error: f64) -> bool {
        let spp = self.progress.map_or(0, |progress| progress.spp);
        self.next_look = spp.saturating_mul(2).max(FIRST_LOOK);
        error <= ROUNDING
    }

    /// Learns what a frame took besides tracing.
    pub fn learn_drawing(&mut self, took: Duration) {
        self.drawing = (self.drawing * 3 + took) / 4;
    }
}
