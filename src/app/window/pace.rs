//! How fast frames follow each other, and how large the film is while the picture moves.

use std::time::{Duration, Instant};

use glam::UVec2;

/// Time between two frames: 60 a second, also where presenting doesn't wait for the display.
pub const FRAME: Duration = Duration::from_micros(16_667);

/// Tracing in a frame of a picture that stands still: the rest of the frame is for drawing and input.
pub const STEP: Duration = Duration::from_millis(12);

/// Tracing in any frame, at most.
const LONGEST_STEP: Duration = Duration::from_millis(100);

/// What a whole sample may take while the picture moves.
pub const MOVING_SAMPLE: Duration = Duration::from_millis(50);

/// The picture stands still if nothing moved it for so long.
pub const SETTLED: Duration = Duration::from_millis(150);

/// The film is divided by this at most.
const MOST_DIVISOR: u32 = 8;

/// Knows how fast samples come, and when the picture was last moved.
#[derive(Debug)]
pub struct Pace {
    /// Samples a second; 0 before the first measurement.
    rate: f64,
    /// When the picture will stand still; none if it does.
    settles: Option<Instant>,
    /// Pixels that the device has room for.
    most_pixels: u64,
}

impl Pace {
    /// Nothing is known yet, and nothing moves.
    pub fn new(most_pixels: u64) -> Self {
        Self { rate: 0.0, settles: None, most_pixels }
    }

    /// Takes note of a step's samples, over all pixels, and of the seconds that tracing took.
    pub fn learn(&mut self, samples: u64, seconds: f64) {
        if samples == 0 {
            return;
        }
        let rate = samples as f64 / seconds.max(1e-6);
        self.rate = if self.rate == 0.0 { rate } else { self.rate + 0.25 * (rate - self.rate) };
    }

    /// The picture was moved.
    pub fn moved(&mut self, now: Instant) {
        self.settles = Some(now + SETTLED);
    }

    /// When the picture will stand still; none if it does.
    pub fn settles_at(&self) -> Option<Instant> {
        self.settles
    }

    /// Whether it stands still since the last call.
    pub fn settle(&mut self, now: Instant) -> bool {
        self.settles.take_if(|at| *at <= now).is_some()
    }

    /// The film's size for a window that it fills: smaller while the picture moves, if samples come slowly, and where the
    /// device has no room for all of it.
    pub fn film_size(&self, window: UVec2) -> UVec2 {
        let wanted = if self.settles.is_some() { divisor(window, self.rate) } else { 1 };
        let pixels = |size: UVec2| u64::from(size.x) * u64::from(size.y);
        let fits = |divisor: &u32| pixels(divided(window, *divisor)) <= self.most_pixels;
        let divisors = std::iter::successors(Some(wanted), |divisor| divisor.checked_mul(2));
        divided(window, divisors.take(16).find(fits).unwrap_or(wanted))
    }
}

/// Tracing in a frame of a picture that stands still, where all else in it takes so long: most of the time is for tracing,
/// as long as a hand does not feel the frame.
pub fn still_step(else_takes: Duration) -> Duration {
    STEP.max(2 * else_takes).min(LONGEST_STEP)
}

/// How often a side is halved, as a power of two, for a whole sample to take no longer than [`MOVING_SAMPLE`]. `rate` in
/// samples a second; 0 if it isn't known yet.
pub fn divisor(window: UVec2, rate: f64) -> u32 {
    if rate <= 0.0 {
        return 1;
    }
    let seconds = f64::from(window.x) * f64::from(window.y) / rate;
    let mut divisor = 1;
    while divisor < MOST_DIVISOR && seconds / f64::from(divisor * divisor) > MOVING_SAMPLE.as_secs_f64() {
        divisor *= 2;
    }
    divisor
}

/// A size divided on both sides, each at least 1.
pub fn divided(size: UVec2, divisor: u32) -> UVec2 {
    (size / divisor.max(1)).max(UVec2::ONE)
}
