//! Sizes each batch so that a submission takes about the time it may.

use bevy_ecs::prelude::*;

/// Samples of the very first batch: some hundredths of a second on a slow processor. What follows grows quickly.
const FIRST_SAMPLES: f64 = 4096.0;

/// A batch is at most this many times the last: one measurement may be off.
const GROWTH: f64 = 4.0;

/// Learns how many samples a second the scene takes.
#[derive(Resource, Default)]
pub struct Governor {
    /// Samples a second; 0 before the first measurement.
    rate: f64,
    last: f64,
}

impl Governor {
    /// How many samples, over all pixels, fit into `seconds`; at least 1.
    pub fn samples(&self, seconds: f64) -> f64 {
        if self.rate == 0.0 {
            return FIRST_SAMPLES;
        }
        (self.rate * seconds).min(self.last * GROWTH).max(1.0)
    }

    /// Takes note of a batch and the time it took.
    pub fn learn(&mut self, samples: u64, seconds: f64) {
        let rate = samples as f64 / seconds.max(1e-6);
        // A mean over about four batches: pictures are dearer in some rows than in others.
        self.rate = if self.rate == 0.0 { rate } else { self.rate + 0.25 * (rate - self.rate) };
        self.last = samples as f64;
    }

    /// Forgets what it learnt: the scene is another one.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}
