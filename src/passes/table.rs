//! Every row, for whatever goes over all of them: validation, `check`, tests.

use super::{CLEAR, Pass, film};

/// Every pass the engine can run.
pub static TABLE: &[&Pass] = &[&CLEAR, &film::ACCUMULATE, &film::DISPLAY];
