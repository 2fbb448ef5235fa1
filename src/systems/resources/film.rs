//! How far the film has come, and what this run of the schedule adds to it.

use bevy_ecs::prelude::*;

use crate::layout::view::ViewMode;

/// How far the film of its entity has come. The default is a film that has not begun, which is how one starts anew.
#[derive(Component, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilmProgress {
    /// There is room for it, and its words are set to zero before the first sample.
    pub begun: bool,
    /// Samples that every pixel of the window has.
    pub samples: u32,
    /// Rows, from the top, that have one more.
    pub rows: u32,
    /// What the picture shows of this very film and scene; none while it shows what was before.
    pub shown: Option<ViewMode>,
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
    }

    /// Rows, from the top, that have a sample, of a window of so many.
    pub fn rows_traced(&self, height: u32) -> u32 {
        match (self.begun, self.samples) {
            (false, _) => 0,
            (true, 0) => self.rows,
            (true, _) => height,
        }
    }
}

/// The samples this run of the schedule adds.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    pub first_sample: u32,
    /// Samples a pixel; more than one only with all rows.
    pub layers: u32,
    pub first_row: u32,
    pub rows: u32,
}

impl Batch {
    /// Whether it adds nothing.
    pub fn is_empty(&self) -> bool {
        self.layers == 0
    }

    /// Samples of the batch, over all its pixels.
    pub fn samples(&self, width: u32) -> u64 {
        u64::from(self.layers) * u64::from(self.rows) * u64::from(width)
    }
}
