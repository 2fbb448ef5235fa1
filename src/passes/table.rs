//! Every row, for whatever goes over all of them: validation, `check`, tests.

use super::{CLEAR, Pass, extend, film};

/// Every pass the engine can run.
pub static TABLE: &[&Pass] = &[&CLEAR, &extend::EXTEND, &extend::OCCLUDED, &film::ACCUMULATE, &film::DISPLAY];
