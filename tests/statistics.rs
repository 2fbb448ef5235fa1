//! The statistics by which estimators are held equal, and distributions held to their pdf.

/// Batches behind each standard error.
pub const BATCHES: usize = 32;

/// Standard errors that a difference may reach. Student's t with 31 degrees of freedom is beyond 6.4 with a probability of
/// 4e-7: a family of 250 comparisons fails falsely with 1e-4.
const MOST_ERRORS: f64 = 6.4;

/// Part of the mean by which rounding alone may move one of two estimators.
const ROUNDING: f64 = 1e-5;

/// Part of the mean above which a standard error proves nothing.
const MOST_NOISE: f64 = 0.003;

/// One estimate a batch by each of two estimators, for one block of pixels and one channel.
pub struct Pairs {
    pub differences: [f64; BATCHES],
    /// Mean of the one that is right.
    pub mean: f64,
}

/// Whether |difference| <= z * se + 1e-5 * mean, with se below 0.3 % of the mean; what is wrong if not.
pub fn agree(pairs: &Pairs) -> Result<(), String> {
    let n = BATCHES as f64;
    let difference = pairs.differences.iter().sum::<f64>() / n;
    let squares = pairs.differences.iter().map(|d| (d - difference).powi(2)).sum::<f64>();
    let error = (squares / (n - 1.0) / n).sqrt();
    if error > MOST_NOISE * pairs.mean {
        return Err(format!("the standard error {error:e} is too large for a mean of {:e}", pairs.mean));
    }
    let allowed = MOST_ERRORS * error + ROUNDING * pairs.mean;
    match difference.abs() <= allowed {
        true => Ok(()),
        false => Err(format!("differ by {difference:e}, allowed {allowed:e}, mean {:e}", pairs.mean)),
    }
}

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

#[test]
fn planted_differences_are_seen() {
    let noise = |i: usize| ((i * 7919 % 31) as f64 / 15.0 - 1.0) * 1e-3;
    let shifted = |by: f64| Pairs { differences: std::array::from_fn(|i| noise(i) + by), mean: 1.0 };
    agree(&shifted(0.0)).unwrap();
    assert!(agree(&shifted(0.01)).is_err());
    assert!(agree(&Pairs { differences: shifted(0.0).differences, mean: 0.01 }).is_err());
}
