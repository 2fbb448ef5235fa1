//! Flying: speed that grows and fades smoothly, whatever the frame rate.

use std::time::Duration;

use glam::DVec3;

/// Seconds in which speed comes within 1/e of what is wanted.
const EASE: f64 = 0.08;

/// Slower than this part of full speed, a flight that nobody wants on has ended.
const STILL: f64 = 0.01;

/// The motion of a camera that flies: right, up and forward, in parts of full speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flight {
    velocity: DVec3,
}

impl Flight {
    /// Goes on for a while with the direction that is wanted. Returns how far it went, in seconds of full speed.
    pub fn advance(&mut self, wanted: DVec3, time: Duration) -> DVec3 {
        let wanted = wanted.clamp_length_max(1.0);
        let seconds = time.as_secs_f64();
        let fade = (-seconds / EASE).exp();
        // The integral of a speed that nears what is wanted exponentially: the same way, in one frame or in many.
        let way = wanted * seconds + (self.velocity - wanted) * (EASE * (1.0 - fade));
        self.velocity = wanted + (self.velocity - wanted) * fade;
        if wanted == DVec3::ZERO && self.velocity.length() < STILL {
            self.velocity = DVec3::ZERO;
        }
        way
    }

    /// Whether it moves.
    pub fn is_under_way(&self) -> bool {
        self.velocity != DVec3::ZERO
    }
}
