//! What keeps a window busy: whether there is anything to trace or to draw, and when the last frame was.

use std::time::{Duration, Instant};

/// A frame that takes longer does not make a flight longer.
const LONGEST_FRAME: Duration = Duration::from_millis(100);

/// What there is to do, and whether anybody sees it.
pub struct Activity {
    /// The engine has something to do.
    pub working: bool,
    /// There is something to draw.
    pub redraw: bool,
    /// Nothing of the window is to be seen.
    pub hidden: bool,
    /// The window is to close.
    pub quit: bool,
    /// When the user interface wants to be drawn again.
    pub ui_again: Option<Instant>,
    pub last_frame: Instant,
    /// A frame was drawn already.
    started: bool,
}

impl Activity {
    /// Everything is to be done yet.
    pub fn new(now: Instant) -> Self {
        Self {
            working: true,
            redraw: true,
            hidden: false,
            quit: false,
            ui_again: None,
            last_frame: now,
            started: false,
        }
    }

    /// Begins a frame. Returns the time since the last one, as far as motion follows it.
    pub fn begin_frame(&mut self, now: Instant) -> Duration {
        now.duration_since(std::mem::replace(&mut self.last_frame, now)).min(LONGEST_FRAME)
    }

    /// True once: for the first frame.
    pub fn starts(&mut self) -> bool {
        !std::mem::replace(&mut self.started, true)
    }

    /// Has the user interface drawn again, once it is time to.
    pub fn expire(&mut self, now: Instant) {
        self.redraw |= self.ui_again.take_if(|at| *at <= now).is_some();
    }
}
