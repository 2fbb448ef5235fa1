//! Stable least-significant-digit radix sort of pairs: 64-bit keys, 32-bit payload.
//!
//! Reduce, then scan: every step sees what the dispatch before it wrote, and nothing else. `agree` and `plan` find the
//! digits in which all keys agree; these cost three empty indirect dispatches each. For the others, `count` makes a
//! histogram of each tile, `scan` sums it over tiles, and `scatter` moves the pairs.
//!
//! Per pair and digit that is 8 bytes read by `count`, 12 read and 12 written by `scatter`.

use std::mem::{offset_of, size_of};

use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::sort::{SORT_BINS, SORT_DIGITS, SORT_FEW_TILES, SortDigit, SortParams, SortPlan, tiles};

const KEYS: &str = "array<vec2<u32>>";
const WORDS: &str = "array<u32>";
/// Tests count the workgroups that ran, by digit and stage.
const CENSUS: Binding = Binding::write("sort_census", "array<atomic<u32>>").when(&["sort_census"]);

/// Finds the bits in which the keys of each tile agree.
pub static SORT_AGREE: Pass = Pass {
    name: "sort agree",
    module: "passes/sort/agree",
    entry: "agree",
    features: &[],
    bindings: &[
        Binding::params("SortParams"),
        Binding::read("keys", KEYS),
        Binding::write("sort_agreements", "array<vec4<u32>>"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(sort::agree),
};

/// Decides which digits run, and from where to where.
pub static SORT_PLAN: Pass = Pass {
    name: "sort plan",
    module: "passes/sort/plan",
    entry: "plan",
    features: &[],
    bindings: &[
        Binding::params("SortParams"),
        Binding::read("sort_agreements", "array<vec4<u32>>"),
        Binding::write("sort_plan", "SortPlan"),
    ],
    makes: &[Makes::Tree],
    twin: twin!(sort::plan),
};

/// Histogram of a digit over each tile.
pub static SORT_COUNT: Pass = Pass {
    name: "sort count",
    module: "passes/sort/count",
    entry: "count",
    features: &[],
    bindings: &[
        Binding::params("SortParams"),
        Binding::read("sort_plan", "SortPlan"),
        Binding::read("keys", KEYS),
        Binding::read("keys_back", KEYS),
        Binding::write("sort_counts", WORDS),
        CENSUS,
    ],
    makes: &[Makes::Tree],
    twin: twin!(sort::count),
};

/// Sums a digit's histograms over the tiles before each.
pub static SORT_SCAN: Pass = Pass {
    name: "sort scan",
    module: "passes/sort/scan",
    entry: "scan",
    features: &[],
    bindings: &[
        Binding::params("SortParams"),
        Binding::write("sort_counts", WORDS),
        Binding::write("sort_totals", WORDS),
        CENSUS,
    ],
    makes: &[Makes::Tree],
    twin: twin!(sort::scan),
};

/// The same, for at most [`SORT_FEW_TILES`] tiles.
pub static SORT_SCAN_FEW: Pass = Pass { name: "sort scan few", entry: "scan_few", ..SORT_SCAN };

/// Moves the pairs to their places by a digit.
pub static SORT_SCATTER: Pass = Pass {
    name: "sort scatter",
    module: "passes/sort/scatter",
    entry: "scatter",
    features: &[],
    bindings: &[
        Binding::params("SortParams"),
        Binding::read("sort_plan", "SortPlan"),
        Binding::read("sort_counts", WORDS),
        Binding::read("sort_totals", WORDS),
        Binding::write("keys", KEYS),
        Binding::write("payload", WORDS),
        Binding::write("keys_back", KEYS),
        Binding::write("payload_back", WORDS),
        CENSUS,
    ],
    makes: &[Makes::Tree],
    twin: twin!(sort::scatter),
};

/// Makes pairs of random 63-bit keys and their indices, for benchmarks.
pub static SORT_FILL: Pass = Pass {
    name: "sort fill",
    module: "passes/sort/fill",
    entry: "fill",
    features: &[],
    bindings: &[Binding::params("SortParams"), Binding::write("keys", KEYS), Binding::write("payload", WORDS)],
    makes: &[],
    twin: twin!(sort::random_key),
};

/// Buffers of a sort of `count` pairs, with their bytes.
pub fn buffers(count: u32) -> Vec<(&'static str, u64)> {
    let (n, tiles) = (u64::from(count), u64::from(tiles(count)));
    vec![
        ("keys", 8 * n),
        ("payload", 4 * n),
        ("keys_back", 8 * n),
        ("payload_back", 4 * n),
        ("sort_agreements", 16 * tiles),
        ("sort_plan", size_of::<SortPlan>() as u64),
        ("sort_counts", 4 * u64::from(SORT_BINS) * tiles),
        ("sort_totals", 4 * u64::from(SORT_BINS * SORT_DIGITS)),
    ]
}

/// Where the words of an indirect dispatch for a digit lie in `sort_plan`, at `field` of its [`SortDigit`].
const fn words_of(digit: u32, field: usize) -> Size {
    let offset = offset_of!(SortPlan, digits) + digit as usize * size_of::<SortDigit>() + field;
    Size::Indirect { buffer: "sort_plan", offset: offset as u64 }
}

/// Records the sort of the first `count` pairs of `keys` and `payload`. Afterwards, `sort_plan.result` says whether the
/// result is in these or in `keys_back` and `payload_back`; the other pair of buffers is scratch.
pub fn record(recording: &mut Recording, count: u32) {
    let params = |digit| SortParams { count, tiles: tiles(count), digit };
    recording.run(&SORT_AGREE, Size::Groups([tiles(count), 1, 1])).params(&params(0));
    recording.run(&SORT_PLAN, Size::Groups([1, 1, 1])).params(&params(0));
    let scan = if tiles(count) <= SORT_FEW_TILES { &SORT_SCAN_FEW } else { &SORT_SCAN };
    for digit in 0..SORT_DIGITS {
        let on_tiles = words_of(digit, offset_of!(SortDigit, tiles_x));
        let on_bins = words_of(digit, offset_of!(SortDigit, bins_x));
        recording.run(&SORT_COUNT, on_tiles).params(&params(digit));
        recording.run(scan, on_bins).params(&params(digit));
        recording.run(&SORT_SCATTER, on_tiles).params(&params(digit));
    }
}

/// Records the making of `count` pairs with random keys; [`crate::cpu::sort::random_key`] is their twin.
pub fn record_fill(recording: &mut Recording, count: u32) {
    let params = SortParams { count, tiles: tiles(count), digit: 0 };
    recording.run(&SORT_FILL, Size::Items(u64::from(count))).params(&params);
}
