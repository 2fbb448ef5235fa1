//! How fast frames follow each other, and how large the film is.

use std::time::{Duration, Instant};

use glam::UVec2;

/// Time between two frames: 60 a second, also where presenting doesn't wait for the display.
pub const FRAME: Duration = Duration::from_micros(16_667);

/// Tracing in a frame of a picture that stands still: the rest of the frame is for drawing and input.
pub const STEP: Duration = Duration::from_millis(12);

/// Tracing in any frame, at most.
const LONGEST_STEP: Duration = Duration::from_millis(100);

/// Tracing in a frame of a picture that moves, on a processor: what is drawn follows the hand, and is as fine as it can be in that.
pub const MOVING_STEP: Duration = Duration::from_millis(50);

/// The picture stands still if nothing moved it for so long.
pub const SETTLED: Duration = Duration::from_millis(150);

/// Knows when the picture was last moved, and what the device has room for.
#[derive(Debug)]
pub struct Pace {
    moved: Option<Instant>,
    /// Pixels that the device has room for.
    most_pixels: u64,
}

impl Pace {
    /// Nothing moves.
    pub fn new(most_pixels: u64) -> Self {
        Self { moved: None, most_pixels }
    }

    /// The picture was moved.
    pub fn moved(&mut self, now: Instant) {
        self.moved = Some(now);
    }

    /// Whether it moves.
    pub fn moves(&self, now: Instant) -> bool {
        self.moved.is_some_and(|at| now < at + SETTLED)
    }

    /// The film's size for a window that it fills: halved where the device has no room for all of it.
    pub fn film_size(&self, window: UVec2) -> UVec2 {
        let pixels = |size: UVec2| u64::from(size.x) * u64::from(size.y);
        let halved = |halvings: u32| (window >> halvings).max(UVec2::ONE);
        (0..16).map(halved).find(|size| pixels(*size) <= self.most_pixels).unwrap_or(window)
    }
}

/// Tracing in a frame of a picture that stands still, where all else in it takes so long: most of the time is for tracing,
/// as long as a hand does not feel the frame.
pub fn still_step(else_takes: Duration) -> Duration {
    STEP.max(2 * else_takes).min(LONGEST_STEP)
}
