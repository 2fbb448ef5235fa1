//! Whether draws are those of a density, by counts in cells.

/// How many standard deviations chi-square lies above what its degrees of freedom let expect, by Wilson and Hilferty's
/// transformation to a normal variable (1931), whose tail is good to a few percent from 30 degrees on.
///
/// Cells of fewer than 20 expected draws are joined. `expected` need not sum to the number of draws: a pdf that does not
/// integrate to 1 is wrong too.
pub fn chi_square_z(observed: &[u64], expected: &[f64]) -> f64 {
    let (mut statistic, mut cells) = (0.0, 0.0);
    let (mut seen, mut awaited) = (0.0, 0.0);
    for (&o, &e) in observed.iter().zip(expected) {
        (seen, awaited) = (seen + o as f64, awaited + e);
        if awaited >= 20.0 {
            statistic += (seen - awaited) * (seen - awaited) / awaited;
            cells += 1.0;
            (seen, awaited) = (0.0, 0.0);
        }
    }
    // Draws where hardly any are expected count against the pdf.
    statistic += (seen - awaited).powi(2) / awaited.max(1.0);
    let degrees: f64 = cells - 1.0;
    assert!(degrees >= 30.0, "too few cells");
    let spread = 2.0 / (9.0 * degrees);
    ((statistic / degrees).cbrt() - (1.0 - spread)) / spread.sqrt()
}

/// One-sided p = 1e-4 / 40: the chi-square tests of this crate are fewer than 40.
pub const CHI_SQUARE_LIMIT: f64 = 4.56;
