//! Which samples come next on a film: whole layers of them, or some rows of a sweep over one.

use glam::UVec2;

use crate::layout::trace::TILE_BLOCK;
use crate::passes::lattice::{Lattice, corners, level_within, refinement};
use crate::passes::trace;
use crate::systems::resources::{Batch, FilmProgress, Shot, Sweep};

/// What reuse of paths asks of a batch.
pub struct Reused {
    /// Pixels of the whole blocks that the window touches.
    pixels: u64,
    /// Pixels whose records fit at once.
    pub fit: u64,
    /// The row of the window at which its first blocks end.
    first_end: u32,
}

impl Reused {
    /// `limit`: bytes that a buffer of samples may have.
    pub fn of(shot: &Shot, limit: u64) -> Self {
        let blocks = trace::whole_blocks(&shot.params);
        let largest = trace::reuse_buffers(1, 1, shot.is_textured()).into_iter().map(|(_, bytes)| bytes).max();
        Self {
            pixels: u64::from(blocks.window_width) * u64::from(blocks.window_height),
            fit: (limit / largest.unwrap_or(1)).max(1),
            first_end: TILE_BLOCK - shot.params.window_y % TILE_BLOCK,
        }
    }

    /// The row, after `first` and not beyond `end` unless there is none, at which blocks end. `first` is such a row, or the window's first.
    fn end_of_rows(&self, first: u32, end: u32) -> u32 {
        let next = if first < self.first_end { self.first_end } else { first + TILE_BLOCK };
        next + end.saturating_sub(next) / TILE_BLOCK * TILE_BLOCK
    }
}

/// Plans the batches of a film.
pub struct Planner {
    /// Of the window, pixels.
    pub size: UVec2,
    /// Somebody watches.
    pub live: bool,
    pub reuse: Option<Reused>,
}

impl Planner {
    /// The batch that follows on a film: about as many samples as are wanted, in so many layers at most.
    pub fn next_batch(&self, progress: &FilmProgress, samples: u64, most_layers: u64) -> Batch {
        let Self { size, live, .. } = *self;
        let first_sample = progress.samples;
        let mut layers = (samples / Lattice::default().pixels(size)).min(most_layers);
        if self.reuse.as_ref().is_some_and(|reuse| reuse.pixels > reuse.fit) {
            layers = 0;
        }
        if !progress.is_between() && layers >= 1 {
            return Batch { first_sample, layers: layers as u32, rows: size.y, ..Batch::default() };
        }
        let sweep = self.next_sweep(progress, samples);
        let (first_row, extent) = (progress.rows, sweep.pixels.size(size));
        let rows = match live && progress.is_empty() {
            // Whoever watches sees a film whole from its first batch on.
            true => extent.y,
            false => self.next_rows(sweep, first_row, extent, samples),
        };
        Batch { first_sample, layers: 1, sweep, first_row, rows, tiles: None }
    }

    /// How many of a sweep's rows make about so many samples.
    fn next_rows(&self, sweep: Sweep, first_row: u32, extent: UVec2, samples: u64) -> u32 {
        let left = extent.y - first_row;
        let of = |samples: u64| (samples / u64::from(extent.x)).clamp(1, u64::from(left)) as u32;
        match &self.reuse {
            Some(reuse) if !sweep.preview => {
                let rows = of(samples.min(reuse.fit / 2));
                if rows == left { rows } else { (reuse.end_of_rows(first_row, first_row + rows) - first_row).min(left) }
            }
            _ => of(samples),
        }
    }

    /// The sweep that is under way, or the next: of all pixels, or, where somebody waits for the first sample, of a level.
    fn next_sweep(&self, progress: &FilmProgress, samples: u64) -> Sweep {
        let preview = self.reuse.is_some();
        match progress.level {
            _ if progress.rows > 0 => progress.sweep,
            Some(level) => Sweep { pixels: refinement(level - 1), level: level - 1, preview },
            None if self.live && progress.samples == 0 && !progress.previewed => {
                let level = level_within(self.size, samples);
                Sweep { pixels: corners(level), level, preview }
            }
            None => Sweep::default(),
        }
    }
}
