//! When the device is free for judging: once no hand has touched the window for a while. Pure.

use std::time::{Duration, Instant};

/// The window is left alone if nothing touched it for so long.
pub const REST: Duration = Duration::from_secs(2);

/// When a hand last touched the window.
#[derive(Clone, Copy, Debug)]
pub struct Attention(Instant);

impl Attention {
    /// The window opens, which a hand did.
    pub fn new(now: Instant) -> Self {
        Self(now)
    }

    /// A hand moves something, or something was saved.
    pub fn touch(&mut self, now: Instant) {
        self.0 = now;
    }

    /// From when on the device is free, if nothing touches the window before.
    pub fn free_at(&self) -> Instant {
        self.0 + REST
    }
}
