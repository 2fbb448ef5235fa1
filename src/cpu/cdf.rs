//! Drawing an index by the sums of weights in f64: the twin of `lib/cdf`.

use crate::layout::cdf::HALF_STEP;

/// An index of a table, and what is left of the uniform number; `entry` is the sum up to an index, and the first index of a bucket.
pub fn draw_index(count: usize, u: f64, entry: impl Fn(usize) -> (f32, u32)) -> (usize, f64) {
    let end = |index: usize| f64::from(entry(index).0);
    let buckets = 1 << count.ilog2();
    let bucket = ((u * buckets as f64) as usize).min(buckets - 1);
    let mut low = entry(bucket).1 as usize;
    let mut high = if bucket + 1 < buckets { entry(bucket + 1).1 as usize } else { count - 1 };
    while low < high {
        let middle = (low + high) / 2;
        if u < end(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    let start = if low > 0 { end(low - 1) } else { 0.0 };
    (low, left_over(u, start, end(low)))
}

/// What is left of a uniform number of an entry.
pub fn left_over(u: f64, start: f64, end: f64) -> f64 {
    ((u - start + f64::from(HALF_STEP)) / (end - start)).min(1.0 - f64::EPSILON)
}

/// A uniform number from `start` to `end`, stretched to [0, 1).
pub fn stretched(u: f64, start: f64, end: f64) -> f64 {
    ((u - start) / (end - start)).min(1.0 - f64::EPSILON)
}
