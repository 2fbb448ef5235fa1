//! One sample of one pixel, with what happens on its way: for who wants to know why it is what it is.

use super::trace::{TRACED, reuse_buffers};
use super::twin::twin;
use super::{Binding, Pass, Recording, Size};
use crate::layout::probe::{MOST_PROBED, Probed};
use crate::layout::replay::{MOST_TURNS, PathTurn, Replayed};
use crate::layout::trace::TraceParams;

/// Traces as [`PATH`](super::trace::PATH) does, and leaves the path's rays in `turns`, and what code shows of itself in `probed`.
pub static REPLAY: Pass = Pass {
    name: "replay",
    module: "passes/trace/replay",
    entry: "replay",
    features: &["record"],
    bindings: &Binding::list::<22>(&[&TRACED, &[Binding::write("replayed", "Replayed")]]),
    makes: &[],
    twin: twin!(replay::replay),
};

/// Buffers of the pass; of what paths lend there is one place.
pub fn buffers() -> Vec<(&'static str, u64)> {
    let mut buffers = reuse_buffers(1, 1, true);
    buffers.push(("turns", u64::from(MOST_TURNS) * size_of::<PathTurn>() as u64));
    buffers.push(("probed", u64::from(MOST_PROBED) * size_of::<Probed>() as u64));
    buffers.push(("replayed", size_of::<Replayed>() as u64));
    buffers
}

/// Records sample `first_sample` of the first pixel of the window of `params`.
pub fn record(recording: &mut Recording, params: &TraceParams) {
    recording.run(&REPLAY, Size::Groups([1, 1, 1])).params(params);
}
