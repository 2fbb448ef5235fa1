//! Drawing from an alias table in f64: the twin of `lib/alias`.

use crate::layout::alias::HALF_STEP;

/// The column of `count` that a uniform number is in, and the remainder below which the column may stand for itself.
pub fn alias_pick(u: f64, count: usize) -> (usize, f64) {
    let scaled = u * count as f64;
    let column = (scaled as usize).min(count - 1);
    (column, (scaled - column as f64 + count as f64 * f64::from(HALF_STEP)).min(1.0))
}
