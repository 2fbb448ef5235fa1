//! Alias tables by given weights (Walker 1977; Vose 1991).

use crate::layout::alias::AliasColumn;

/// The table that draws index `i` with the probability `weights[i]` / their sum, to the rounding of f32. Weights are finite and
/// at least 0; one of weight 0 is never drawn. Empty if there is no weight above 0.
///
/// A uniform number u in [0, 1) is column floor(u * n), with the remainder u * n - floor(u * n) to compare with the threshold.
pub fn alias_table(weights: &[f64]) -> Vec<AliasColumn> {
    let total: f64 = weights.iter().sum();
    if !(total > 0.0 && total.is_finite()) {
        return Vec::new();
    }
    // Divided by the sum, whose reciprocal need not be finite.
    let columns = weights.len() as f64;
    let mut shares: Vec<f64> = weights.iter().map(|weight| weight / total * columns).collect();
    let (mut small, mut large): (Vec<u32>, Vec<u32>) =
        (0..weights.len() as u32).partition(|&i| shares[i as usize] < 1.0);
    let mut table: Vec<AliasColumn> =
        (0..weights.len() as u32).map(|other| AliasColumn { threshold: 1.0, other }).collect();
    while let (Some(poor), Some(&rich)) = (small.pop(), large.last()) {
        table[poor as usize] = AliasColumn { threshold: shares[poor as usize] as f32, other: rich };
        shares[rich as usize] -= 1.0 - shares[poor as usize];
        if shares[rich as usize] < 1.0 {
            large.pop();
            small.push(rich);
        }
    }
    // What rounding left over has a share of 1; but nothing may be drawn that has no weight.
    let heaviest = (0..weights.len()).max_by(|a, b| weights[*a].total_cmp(&weights[*b])).unwrap_or(0) as u32;
    for (column, weight) in table.iter_mut().zip(weights) {
        if *weight == 0.0 && column.threshold > 0.0 {
            *column = AliasColumn { threshold: 0.0, other: heaviest };
        }
    }
    table
}
