//! One sample of one pixel with all that happens on its way, in f64: the twin of `passes/trace/replay`; and whether what the kernel kept of
//! the same sample is that but for rounding.

mod compare;
mod quantities;
mod record;
mod shaken;
mod verdict;

use glam::UVec2;

pub use compare::{Compared, Comparison, Parting, Row};
pub use quantities::{Measure, Values, numbers_of};
pub use verdict::{Verdict, Why, judge};

use self::record::Recorder;
use super::path::{PathScene, Walked};
use super::turn::Turn;
use crate::layout::trace::TraceParams;

/// Which path it is.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Of the whole film.
    pub pixel: UVec2,
    /// Of the film: even ones belong to half 0, odd ones to half 1.
    pub sample: u32,
    /// The path lends to its tile.
    pub lends: bool,
}

/// The rays of a path in order, and what it comes to.
pub fn replay(scene: &PathScene, params: &TraceParams, of: Sample) -> (Vec<Turn>, Walked) {
    let mut recorder = Recorder::default();
    let walked = scene.walk_watched(params, of.pixel, of.sample, of.lends, &mut recorder);
    (recorder.turns, walked)
}
