//! Whether numbers of any distribution that is symmetric about zero add up to more than chance lets them: by flipping their
//! signs.
//!
//! Given their sizes, the signs of such numbers are independent and fair (Fisher 1935; Efron 1969, "Student's t-test under
//! symmetry conditions"). So the p-value below is right whatever the sizes: one that towers above all others, a firefly,
//! can't make the sum significant by itself, as it can with a normal approximation. A difference of two films by equal code is
//! symmetric because the two may be exchanged.

use super::summary::{mean, upper_quantile, variance};

/// Standard deviations below which the bound would be 1 or little less.
const SMALL: f64 = 1.0;

/// Halvings of what the best k is known to be within: 1e-5 of it, and of the bound's logarithm far less.
const HALVINGS: u32 = 16;

/// Probability that a shift of the size that [`least_found`] tells is missed.
pub const MISSED: f64 = 0.05;

/// An upper bound of the probability that |sum of the sizes with random signs| is at least |`sum`|.
///
/// Chernoff's (1952): 2 min over k of E e^(k (S - sum)) = 2 e^(-k sum) prod cosh(k size). For k large it is exact where all signs agree,
/// 2^(1 - n); for normal sizes it is about ten times the probability at six standard deviations, where a bound by the
/// variance alone (Hoeffding 1963) is off by far more.
pub fn tail_bound(sizes: &[f64], sum: f64) -> f64 {
    let scale = sizes.iter().map(|size| size * size).sum::<f64>().sqrt();
    let x = sum.abs() / scale;
    // Also where there is no number at all, or one that is none.
    if !x.is_finite() || x < SMALL {
        return 1.0;
    }
    let sizes: Vec<f64> = sizes.iter().map(|size| size.abs() / scale).collect();
    // Convex in k: its minimum is where this is 0. tanh(y) <= y, so it is not before k = x.
    let slope = |k: f64| sizes.iter().map(|size| size * (k * size).tanh()).sum::<f64>() - x;
    let (mut low, mut high) = (x, 2.0 * x);
    while slope(high) < 0.0 && high < 1e6 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if slope(middle) < 0.0 { low = middle } else { high = middle }
    }
    // Any k gives a bound.
    let log = sizes.iter().map(|size| ln_cosh(high * size)).sum::<f64>() - high * x;
    (2.0 * log.exp()).min(1.0)
}

/// The least shift of the mean of such numbers whose sum would have a bound below `level`, but for one time in twenty
/// ([`MISSED`]). Their noise is taken to be what they show, less their mean; `None` where no shift would be seen, or there are
/// fewer than two.
pub fn least_found(sizes: &[f64], level: f64) -> Option<f64> {
    let (n, middle) = (sizes.len() as f64, mean(sizes));
    let error = (variance(sizes)? / n).sqrt();
    let seen = |shift: f64| {
        let shifted: Vec<f64> = sizes.iter().map(|size| size - middle + shift).collect();
        tail_bound(&shifted, n * shift) < level
    };
    if error == 0.0 {
        return seen(1.0).then_some(0.0);
    }
    let (mut high, mut doublings) = (error, 0);
    while !seen(high) {
        (high, doublings) = (2.0 * high, doublings + 1);
        if doublings > 40 {
            return None;
        }
    }
    let mut low = 0.0;
    for _ in 0..12 {
        let between = 0.5 * (low + high);
        if seen(between) { high = between } else { low = between }
    }
    Some(high + error * upper_quantile(MISSED, n - 1.0))
}

fn ln_cosh(y: f64) -> f64 {
    y + (-2.0 * y).exp().ln_1p() - std::f64::consts::LN_2
}
