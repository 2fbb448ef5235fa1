//! Tables of sums of given weights, which an index is drawn from (the cutpoint method: Chen and Asau 1974).

use crate::layout::cdf::{CdfEntry, HALF_STEP};

/// The table that draws index `i` with the probability `weights[i]` / their sum, to a step of the uniform numbers, up or down, and an index up to `i`
/// to half of one. Weights are finite and at least 0; one of weight 0 is never drawn. Empty if there is no weight above 0.
pub fn cdf_table(weights: &[f64]) -> Vec<CdfEntry> {
    let total: f64 = weights.iter().sum();
    let Some(last) = weights.iter().rposition(|weight| *weight > 0.0).filter(|_| total.is_finite()) else {
        return Vec::new();
    };
    let step = 2.0 * f64::from(HALF_STEP);
    let mut sum = 0.0;
    let ends = weights.iter().enumerate().map(|(i, weight)| {
        sum += weight;
        // However the sums are rounded, every number is below the last one.
        if i < last { ((sum / total / step).round() * step) as f32 } else { 1.0 }
    });
    let mut table: Vec<CdfEntry> = ends.map(|end| CdfEntry { end, first: 0 }).collect();
    let buckets = 1 << weights.len().ilog2();
    let mut first = 0;
    for bucket in 0..buckets {
        let begin = bucket as f64 / buckets as f64;
        while f64::from(table[first].end) <= begin {
            first += 1;
        }
        table[bucket].first = first as u32;
    }
    table
}
