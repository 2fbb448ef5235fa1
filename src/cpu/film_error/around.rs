//! Sums over the squares around pixels.

use std::ops::Range;

/// For each pixel of some rows, the sum over all pixels at most `reach` columns and rows away, itself among them.
pub fn sums<const N: usize>(values: &[[f64; N]], width: usize, rows: Range<usize>, reach: usize) -> Vec<[f64; N]> {
    let mut all = Vec::with_capacity(rows.len() * width);
    let mut columns = vec![[0.0; N]; width];
    for y in rows {
        columns.fill([0.0; N]);
        for row in near(y, values.len() / width, reach) {
            let row = &values[row * width..(row + 1) * width];
            columns.iter_mut().zip(row).for_each(|(sum, value)| add(sum, value));
        }
        all.extend((0..width).map(|x| {
            let mut sum = [0.0; N];
            columns[near(x, width, reach)].iter().for_each(|column| add(&mut sum, column));
            sum
        }));
    }
    all
}

fn add<const N: usize>(sum: &mut [f64; N], value: &[f64; N]) {
    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
}

/// What is within reach of an index of a list.
fn near(at: usize, count: usize, reach: usize) -> Range<usize> {
    at.saturating_sub(reach)..(at + reach + 1).min(count)
}
