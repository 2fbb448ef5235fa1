//! How much more efficient one estimator is than another: 1 / (relMSE x seconds) of each, and the ratio with its interval.

use super::metrics::DARK;
use super::summary::{mean, upper_quantile, variance};

/// Probability that the interval does not hold the true ratio, on either side.
const ONE_SIDE: f64 = 0.025;

/// Two films of the old estimator and two of the new, traced by turns. The old one's numbers come first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// What the two films say of the relMSE of one.
    pub relmse: [f64; 2],
    /// Of tracing one film.
    pub seconds: [f64; 2],
}

/// Efficiency of the new estimator by that of the old.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    pub ratio: f64,
    /// Bounds of the 95 % confidence interval.
    pub low: f64,
    pub high: f64,
}

impl Ratio {
    /// Half the interval's width by the ratio, as 0.05 for +-5 %; on the log scale, where it is symmetric.
    pub fn spread(&self) -> f64 {
        0.5 * (self.high / self.low).ln()
    }

    /// Of several trials; `None` from fewer than two, or where either has no error or takes no time.
    ///
    /// The standard error of the ratio's logarithm is the jackknife's over trials (Efron, Stein 1981), which takes heavy tails
    /// as they come, and Student's quantile allows for how few they are. A trial holds both estimators, so what slows both
    /// cancels.
    pub fn of(trials: &[Trial]) -> Option<Self> {
        let total = trials.iter().fold([0.0; 4], |sum, trial| add(sum, parts(trial), 1.0));
        let whole = log_ratio(total)?;
        let without = |trial: &Trial| log_ratio(add(total, parts(trial), -1.0));
        let logs: Vec<f64> = trials.iter().map(without).collect::<Option<_>>()?;
        let n = logs.len() as f64;
        let error = ((n - 1.0) * (n - 1.0) / n * variance(&logs)?).sqrt();
        let reach = error * upper_quantile(ONE_SIDE, n - 1.0);
        Some(Self { ratio: whole.exp(), low: (whole - reach).exp(), high: (whole + reach).exp() })
    }
}

fn parts(trial: &Trial) -> [f64; 4] {
    [trial.relmse[0], trial.relmse[1], trial.seconds[0], trial.seconds[1]]
}

fn add(sum: [f64; 4], parts: [f64; 4], sign: f64) -> [f64; 4] {
    std::array::from_fn(|i| sum[i] + sign * parts[i])
}

/// Of relMSE of the old and the new, and seconds of the old and the new, or of as many of each.
fn log_ratio([old, new, old_seconds, new_seconds]: [f64; 4]) -> Option<f64> {
    let log = (old * old_seconds / (new * new_seconds)).ln();
    log.is_finite().then_some(log)
}

/// What trials say of one estimator: relMSE and seconds of a film. `which` is 0 for the old one.
pub fn averages(trials: &[Trial], which: usize) -> (f64, f64) {
    let of = |number: fn(&Trial) -> [f64; 2]| mean(&trials.iter().map(|t| number(t)[which]).collect::<Vec<_>>());
    (of(|trial| trial.relmse), of(|trial| trial.seconds))
}

/// By what squared errors of a pixel are multiplied to be relative: 1 / (radiance^2 + 0.01), by the mean of two pictures.
pub fn weights(a: &[[f32; 3]], b: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let weight = |a: f32, b: f32| (1.0 / ((0.5 * (f64::from(a) + f64::from(b))).powi(2) + DARK)) as f32;
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|c| weight(a[c], b[c]))).collect()
}

/// relMSE of one of two independent films of one estimator, without bias whatever the noise: E (x - y)^2 / 2 is the variance.
///
/// By pairs and not by the variance of all films, since pairs are independent of each other and no film need be kept; of noise
/// with heavy tails, where it matters, that wastes nothing, and of normal noise half.
pub fn pair_error(x: &[[f32; 3]], y: &[[f32; 3]], weights: &[[f32; 3]]) -> f64 {
    let channels = x.as_flattened().iter().zip(y.as_flattened()).zip(weights.as_flattened());
    let sum: f64 = channels.map(|((x, y), w)| 0.5 * (f64::from(*x) - f64::from(*y)).powi(2) * f64::from(*w)).sum();
    sum / (3 * x.len()).max(1) as f64
}
