//! Whether numbers of any distribution that is symmetric about zero add up to more than chance lets them: by flipping their
//! signs.
//!
//! Given their sizes, the signs of such numbers are independent and fair (Fisher 1935; Efron 1969, "Student's t-test under
//! symmetry conditions"). So the p-value below is right whatever the sizes: one that towers above all others, a firefly,
//! can't make the sum significant by itself, as it can with a normal approximation. A difference of two films by equal code is
//! symmetric because the two may be exchanged.

/// Standard deviations below which the bound would be 1 or little less.
const SMALL: f64 = 1.0;

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
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if slope(middle) < 0.0 { low = middle } else { high = middle }
    }
    // Any k gives a bound.
    let log = sizes.iter().map(|size| ln_cosh(high * size)).sum::<f64>() - high * x;
    (2.0 * log.exp()).min(1.0)
}

fn ln_cosh(y: f64) -> f64 {
    y + (-2.0 * y).exp().ln_1p() - std::f64::consts::LN_2
}
