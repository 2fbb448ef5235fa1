//! The bands that a film is rendered in where the device can't hold all of it: whole rows, one band below the other. A film does not depend
//! on how it is cut, so what comes of it is the same to the bit.

use crate::components::Crop;
use crate::layout::film::FilmPixel;
use crate::layout::trace::TILE_BLOCK;

/// Bytes of the film of a band, at most: it is read back whole, and what is made of it waits in memory until it is written.
const MOST_BYTES: u64 = 256 << 20;

/// Where a film is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bands {
    window: Crop,
    /// Of a band, at most.
    rows: u32,
}

impl Bands {
    /// All of a window at once, where an array of the device can have so many bytes; else as many rows as are quickly read back.
    pub fn of(window: Crop, most_bytes: u64) -> Self {
        let size = window.size();
        let row = (u64::from(size.x) * size_of::<FilmPixel>() as u64).max(1);
        let fit = |bytes: u64| (bytes / row).clamp(1, u64::from(size.y.max(1))) as u32;
        let whole = fit(most_bytes) == size.y;
        Self { window, rows: if whole { size.y } else { fit(most_bytes.min(MOST_BYTES)) } }
    }

    /// Whether the window is cut.
    pub fn are_several(&self) -> bool {
        self.rows < self.window.size().y
    }

    /// The band whose first row is `first`; none below the window. It ends where blocks of reused paths do, as long as one of those fits: a
    /// block that is cut is traced twice.
    pub fn band(&self, first: u32) -> Option<Crop> {
        let Crop { min, max } = self.window;
        if first >= max.y {
            return None;
        }
        let end = first.saturating_add(self.rows);
        let whole_blocks = end / TILE_BLOCK * TILE_BLOCK;
        let end = if end >= max.y || whole_blocks <= first { end.min(max.y) } else { whole_blocks };
        Some(Crop { min: min.with_y(first), max: max.with_y(end) })
    }

    /// Has bands be half as high from now on, where the device has no memory for them; false where they can't be lower.
    pub fn halve(&mut self) -> bool {
        let halved = self.rows / 2;
        if halved == 0 {
            return false;
        }
        self.rows = halved;
        true
    }
}
