//! Every row, for whatever goes over all of them: validation, `check`, tests.

use super::tree::lbvh;
use super::{CLEAR, Pass, extend, film, lint, sort, trace, view};

/// Every pass the engine can run.
pub static TABLE: &[&Pass] = &[
    &CLEAR,
    &sort::SORT_AGREE,
    &sort::SORT_PLAN,
    &sort::SORT_COUNT,
    &sort::SORT_SCAN,
    &sort::SORT_SCAN_FEW,
    &sort::SORT_SCATTER,
    &sort::SORT_FILL,
    &lbvh::BOUNDS,
    &lbvh::MORTON,
    &lbvh::LEAVES,
    &lbvh::PYRAMID,
    &lbvh::NODES,
    &extend::EXTEND,
    &extend::OCCLUDED,
    &trace::PATH,
    &film::ACCUMULATE,
    &film::DISPLAY,
    &view::VIEW,
    &lint::LINT,
];
