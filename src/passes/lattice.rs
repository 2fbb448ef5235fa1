//! Pixels in even steps, and the order in which a first sample comes to those that somebody watches: a coarse picture of all
//! the film, then finer ones.
//!
//! The order is that of Adam7 (PNG, third edition, 8.1), with a level more: each level halves the blocks of the one before it, by turns in
//! width and in height, and adds the pixels at the new corners. No pixel comes twice, and the corners of any level are a
//! lattice again, so that a picture can begin at whichever there is time for.

use glam::UVec2;

/// Pixels of a window: columns and rows from `first` on, in steps of powers of two. The default is all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lattice {
    /// The first column and row, from the window's top left.
    pub first: UVec2,
    /// Binary logarithm of the step.
    pub shift: UVec2,
}

impl Lattice {
    /// Columns and rows of it in a window of so many.
    pub fn size(self, window: UVec2) -> UVec2 {
        let step = UVec2::ONE << self.shift;
        (window.saturating_sub(self.first) + step - 1) >> self.shift
    }

    /// Pixels of it in such a window.
    pub fn pixels(self, window: UVec2) -> u64 {
        let size = self.size(window);
        u64::from(size.x) * u64::from(size.y)
    }
}

/// The coarsest level: blocks of 16 by 16 pixels. Level 0 is all pixels.
pub const COARSEST: u32 = 8;

/// The top left corners of the blocks of a level.
pub fn corners(level: u32) -> Lattice {
    Lattice { first: UVec2::ZERO, shift: UVec2::new(level / 2, level.div_ceil(2)) }
}

/// What a level has beyond the next coarser one.
pub fn refinement(level: u32) -> Lattice {
    let shift = corners(level).shift;
    // Either width or height of the blocks was halved.
    let halved = corners(level + 1).shift - shift;
    Lattice { first: halved << shift, shift: shift + halved }
}

/// The finest level whose corners in a window are no more than so many pixels; [`COARSEST`] if there is none.
pub fn level_within(window: UVec2, pixels: u64) -> u32 {
    (0..COARSEST).find(|level| corners(*level).pixels(window) <= pixels).unwrap_or(COARSEST)
}
