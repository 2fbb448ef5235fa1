//! How far the film has come, and what this run of the schedule adds to it.

use bevy_ecs::prelude::*;
use glam::UVec2;

use crate::components::Film;
use crate::layout::view::ViewMode;
use crate::passes::lattice::{Lattice, corners, refinement};

/// How far the film of its entity has come. The default is a film that has not begun, which is how one starts anew.
#[derive(Component, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilmProgress {
    /// There is room for it, and its words are set to zero before the first sample.
    pub begun: bool,
    /// Samples that every pixel of the window has; of an adaptive film, that pixels have on average.
    pub samples: u32,
    /// The corners of this level have one more; none where no level's have.
    pub level: Option<u32>,
    /// Of these pixels, the rows that have one more, from the top; zero between two sweeps.
    pub sweep: Sweep,
    pub rows: u32,
    /// Every pixel has a sample of a preview, which its first sample of the film replaces.
    pub previewed: bool,
    /// The average that tiles are on their way to, and how many samples all pixels have together; zero as long as all pixels have the same number.
    pub goal: u32,
    pub by_tiles: u64,
    /// It is left at what it has.
    pub rests: bool,
    /// What the picture shows of this very film and scene; none while it shows what was before.
    pub shown: Option<ViewMode>,
    /// What the numbers of view "probe" were last asked for, if they are of this very film and scene: name, bounce and part.
    pub probed: Option<[u32; 3]>,
}

/// Pixels that get a sample one after the other.
#[derive(Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sweep {
    pub pixels: Lattice,
    /// The level whose corners have that sample afterwards; 0 is all pixels.
    pub level: u32,
    /// Its samples are a preview: pixels that are apart can't use each other's paths, so a film that reuses paths drops them.
    pub preview: bool,
}

impl FilmProgress {
    /// The film starts anew.
    pub fn restart(&mut self) {
        *self = Self::default();
    }

    /// The picture of the film, if it is that which is shown, is an older one from now on.
    pub fn outdate_beauty(&mut self) {
        self.shown = self.shown.filter(|mode| *mode != ViewMode::Beauty);
    }

    /// A view of the tree, if it is that which is shown, is of an older one from now on.
    pub fn outdate_views(&mut self) {
        self.shown = self.shown.filter(|mode| *mode == ViewMode::Beauty);
        self.probed = None;
    }

    /// View "probe", if it is that which is shown, is to be shown otherwise from now on.
    pub fn outdate_probe(&mut self) {
        self.shown = self.shown.filter(|mode| *mode != ViewMode::Probe);
    }

    /// Whatever is shown was made by other code.
    pub fn outdate_all(&mut self) {
        (self.shown, self.probed) = (None, None);
    }

    /// No pixel has a sample.
    pub fn is_empty(&self) -> bool {
        self.samples == 0 && !self.is_between() && !self.previewed
    }

    /// Some pixels have a sample more than others.
    pub fn is_between(&self) -> bool {
        self.level.is_some() || self.rows > 0 || self.goal > self.samples
    }

    /// Samples that some pixel has.
    pub fn most_samples(&self) -> u32 {
        self.goal.max(self.samples + u32::from(self.is_between()))
    }

    /// The pixels that stand for all of the film, each for its block; none before there are such.
    pub fn shows(&self) -> Option<Lattice> {
        match (self.begun, self.samples) {
            (false, _) => None,
            (true, 0) if !self.previewed => self.level.map(corners),
            (true, _) => Some(Lattice::default()),
        }
    }

    /// Samples of all pixels of the window together.
    pub fn traced(&self, window: UVec2) -> u64 {
        if self.by_tiles > 0 {
            return self.by_tiles;
        }
        let whole = u64::from(self.samples) * Lattice::default().pixels(window);
        let level = self.level.map_or(0, |level| corners(level).pixels(window));
        whole + level + u64::from(self.rows) * u64::from(self.sweep.pixels.size(window).x)
    }

    /// A batch was added to the film of such a window.
    pub fn add(&mut self, batch: &Batch, window: UVec2) {
        if let Some(tiles) = batch.tiles {
            self.samples = if tiles.done { self.goal } else { self.samples };
            return;
        }
        self.sweep = batch.sweep;
        self.rows = batch.first_row + batch.rows;
        if self.rows < self.sweep.pixels.size(window).y {
            return;
        }
        self.rows = 0;
        // A window may be too narrow or too low to have any pixel of a finer level.
        let finer = |level: &u32| *level > 0 && refinement(level - 1).pixels(window) == 0;
        let mut level = self.sweep.level;
        while finer(&level) {
            level -= 1;
        }
        self.level = Some(level).filter(|level| *level > 0);
        if self.level.is_none() && batch.sweep.preview {
            self.previewed = true;
        } else if self.level.is_none() {
            self.samples += batch.layers;
        }
    }
}

/// To be a system's condition: the film has no room yet, and no sample.
pub fn film_has_not_begun(progress: Single<&FilmProgress, With<Film>>) -> bool {
    !progress.begun
}

/// The samples this run of the schedule adds.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    pub first_sample: u32,
    /// Samples a pixel; more than one only of whole films.
    pub layers: u32,
    /// What rows are counted of.
    pub sweep: Sweep,
    pub first_row: u32,
    pub rows: u32,
    /// It is of tiles instead, which get different numbers.
    pub tiles: Option<TileBatch>,
}

/// Samples of tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileBatch {
    /// How many, each of all pixels of a tile.
    pub samples: u32,
    /// Tiles that have some of them.
    pub runs: u32,
    /// Samples of pixels of the window.
    pub pixels: u64,
    /// About as many were asked for.
    pub asked: u64,
    /// Tiles have all that was wanted.
    pub done: bool,
}

impl Batch {
    /// Whether it is what was left of a round of tiles: a submission takes most of its time by itself, and the next batch is not to be as small.
    pub fn is_remainder(&self) -> bool {
        self.tiles.is_some_and(|tiles| 4 * tiles.pixels < tiles.asked)
    }

    /// Whether it adds nothing.
    pub fn is_empty(&self) -> bool {
        self.layers == 0
    }

    /// Whether it is the first of the film itself, after samples that it replaces.
    pub fn begins_after_preview(&self, progress: &FilmProgress) -> bool {
        progress.previewed && progress.samples == 0 && progress.rows == 0 && !self.sweep.preview
    }

    /// Samples of the batch, over all its pixels in such a window.
    pub fn samples(&self, window: UVec2) -> u64 {
        if let Some(tiles) = self.tiles {
            return tiles.pixels;
        }
        u64::from(self.layers) * u64::from(self.rows) * u64::from(self.sweep.pixels.size(window).x)
    }
}
