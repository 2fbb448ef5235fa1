//! Every row, for whatever goes over all of them: validation, `check`, tests.

use super::{
    CLEAR, Pass, adaptive, blocks, debug, extend, film, lint, probe, replay, sort, sources, trace, tree, view,
};

/// Every pass the engine can run.
pub static TABLE: &[&Pass] = &joined::<{ count(STAGES) }>(STAGES);

const STAGES: &[&[&Pass]] = &[
    &[
        &CLEAR,
        &sort::SORT_AGREE,
        &sort::SORT_PLAN,
        &sort::SORT_COUNT,
        &sort::SORT_SCAN,
        &sort::SORT_SCAN_FEW,
        &sort::SORT_SCATTER,
        &sort::SORT_FILL,
    ],
    tree::PASSES,
    &[
        &extend::EXTEND,
        &extend::OCCLUDED,
        &trace::PATH,
        &trace::GATHER,
        &film::ACCUMULATE,
        &adaptive::TALLY,
        &blocks::BLOCKS,
        &film::DISPLAY,
        &view::VIEW,
        &debug::DEBUG,
        &probe::PROBE,
        &probe::PROBE_COLOURS,
        &replay::REPLAY,
        &sources::SOURCES,
        &lint::LINT,
    ],
];

/// Passes of all stages.
const fn count(stages: &[&[&Pass]]) -> usize {
    let (mut sum, mut stage) = (0, 0);
    while stage < stages.len() {
        sum += stages[stage].len();
        stage += 1;
    }
    sum
}

/// The passes of all stages, of which there are `N`, in order.
const fn joined<const N: usize>(stages: &[&[&'static Pass]]) -> [&'static Pass; N] {
    let mut passes = [&CLEAR; N];
    let (mut filled, mut stage) = (0, 0);
    while stage < stages.len() {
        let mut i = 0;
        while i < stages[stage].len() {
            passes[filled] = stages[stage][i];
            filled += 1;
            i += 1;
        }
        stage += 1;
    }
    passes
}
