//! Statistics of measured numbers: summaries, lines, Student's t. Pure functions.

use serde::{Deserialize, Serialize};

/// One quantity over independent seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    pub mean: f64,
    /// Of the mean; none from one value.
    pub standard_error: Option<f64>,
    pub min: f64,
    pub max: f64,
}

impl Summary {
    /// None without values.
    pub fn of(values: &[f64]) -> Option<Self> {
        let n = values.len() as f64;
        let first = *values.first()?;
        Some(Self {
            mean: mean(values),
            standard_error: variance(values).map(|variance| (variance / n).sqrt()),
            min: values.iter().copied().fold(first, f64::min),
            max: values.iter().copied().fold(first, f64::max),
        })
    }
}

/// A slope and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    pub slope: f64,
    /// None from two points of one run: those lie on a line whatever the noise.
    pub standard_error: Option<f64>,
}

/// Where a falling curve meets a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    At(f64),
    /// It was below already at its first point, here.
    Before(f64),
    /// It is above still at its last point, here.
    After(f64),
}

/// 0 without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Of the values, not of their mean; none from fewer than two.
pub fn variance(values: &[f64]) -> Option<f64> {
    let centre = mean(values);
    let squares = values.iter().map(|value| (value - centre).powi(2)).sum::<f64>();
    (values.len() > 1).then(|| squares / (values.len() - 1) as f64)
}

/// The line through points of independent errors by least squares; none from fewer than two places.
pub fn least_squares(points: &[(f64, f64)]) -> Option<Slope> {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / n, sum.1 + point.1 / n));
    let spread = points.iter().map(|point| (point.0 - x).powi(2)).sum::<f64>();
    if points.len() < 2 || spread <= 0.0 {
        return None;
    }
    let slope = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum::<f64>() / spread;
    let rest = points.iter().map(|point| (point.1 - y - slope * (point.0 - x)).powi(2)).sum::<f64>();
    let standard_error = (points.len() > 2).then(|| (rest / (n - 2.0) / spread).sqrt());
    Some(Slope { slope, standard_error })
}

/// The slope of log(mean of `ys` over the runs) against log(x), by least squares.
///
/// `runs` has the values of each run at all of `xs`. A run's values at growing x are sums of the same samples, so their
/// errors are not independent: the standard error is the jackknife's over runs (Efron, Stein 1981). With one run it is
/// that of the residuals. None where a mean is not above 0.
pub fn log_log_slope(xs: &[f64], runs: &[Vec<f64>]) -> Option<Slope> {
    let fit = |without: Option<usize>| {
        let kept = || runs.iter().enumerate().filter(|(run, _)| Some(*run) != without).map(|(_, values)| values);
        let points = xs.iter().enumerate().map(|(i, x)| {
            let values: Vec<f64> = kept().filter_map(|values| values.get(i).copied()).collect();
            let y = mean(&values);
            (*x > 0.0 && y > 0.0).then(|| (x.ln(), y.ln()))
        });
        least_squares(&points.collect::<Option<Vec<_>>>()?)
    };
    let whole = fit(None)?;
    if runs.len() < 2 {
        return Some(whole);
    }
    let slopes: Vec<f64> = (0..runs.len()).map(|run| Some(fit(Some(run))?.slope)).collect::<Option<_>>()?;
    let n = slopes.len() as f64;
    let standard_error = variance(&slopes).map(|variance| ((n - 1.0) * (n - 1.0) / n * variance).sqrt());
    Some(Slope { slope: whole.slope, standard_error })
}

/// Where points (x, y), x rising, fall to a level, on straight lines between their logarithms. None without points, or
/// where one is not above 0.
pub fn crossing(points: &[(f64, f64)], level: f64) -> Option<Crossing> {
    let (first, last) = (points.first()?, points.last()?);
    if points.iter().any(|point| point.0 <= 0.0 || point.1 <= 0.0) {
        return None;
    }
    if first.1 <= level {
        return Some(Crossing::Before(first.0));
    }
    let Some(pair) = points.windows(2).find(|pair| pair[1].1 <= level) else { return Some(Crossing::After(last.0)) };
    let [(x0, y0), (x1, y1)] = [pair[0], pair[1]].map(|(x, y)| (x.ln(), y.ln()));
    Some(Crossing::At((x0 + (x1 - x0) * (level.ln() - y0) / (y1 - y0)).exp()))
}

/// The difference of two means in standard errors, with its degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Welch {
    /// Mean of the first less that of the second, and less the margin.
    pub difference: f64,
    pub t: f64,
    /// By Welch and Satterthwaite (1947).
    pub degrees: f64,
}

impl Welch {
    /// Whether the first mean is greater than the second by more than `margin`. None where one has fewer than two values.
    pub fn of(first: &[f64], second: &[f64], margin: f64) -> Option<Self> {
        let part = |values: &[f64]| Some(variance(values)? / values.len() as f64);
        let (a, b) = (part(first)?, part(second)?);
        let difference = mean(first) - mean(second) - margin;
        let error = (a + b).sqrt();
        if error == 0.0 {
            // No noise at all: any difference counts.
            let t = if difference > 0.0 { f64::INFINITY } else { f64::NEG_INFINITY };
            return Some(Self { difference, t, degrees: 1.0 });
        }
        let (n, m) = (first.len() as f64, second.len() as f64);
        let degrees = (a + b) * (a + b) / (a * a / (n - 1.0) + b * b / (m - 1.0));
        Some(Self { difference, t: difference / error, degrees })
    }

    /// The probability of a t as large by chance.
    pub fn p(&self) -> f64 {
        upper_tail(self.t, self.degrees)
    }
}

/// P(T > t) of Student's t: half of the regularised incomplete beta function at v / (v + t^2), for t above 0.
pub fn upper_tail(t: f64, degrees: f64) -> f64 {
    if t.is_infinite() {
        return if t > 0.0 { 0.0 } else { 1.0 };
    }
    let half = 0.5 * incomplete_beta(degrees / (degrees + t * t), degrees / 2.0, 0.5);
    if t > 0.0 { half } else { 1.0 - half }
}

/// The t that Student's distribution passes with a probability from 1e-9 to 0.5; by bisection, to 12 digits.
pub fn upper_quantile(probability: f64, degrees: f64) -> f64 {
    // One degree of freedom has the longest tail: 1 / (pi t).
    let (mut low, mut high) = (0.0, 1.0 / probability);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if upper_tail(middle, degrees) > probability { low = middle } else { high = middle }
    }
    high
}

/// I_x(a, b) by Gauss's continued fraction, evaluated as Lentz does (1976); x from 0 to 1, a and b above 0.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    // The fraction converges quickly on this side of the mean only.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let front = (a * x.ln() + b * (-x).ln_1p() + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b)).exp() / a;
    let away = |value: f64| if value.abs() < 1e-300 { 1e-300 } else { value };
    let (mut c, mut d) = (1.0, 1.0 / away(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in (1..500).map(f64::from) {
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut step = 1.0;
        for term in [even, odd] {
            d = 1.0 / away(1.0 + term * d);
            c = away(1.0 + term / c);
            step = c * d;
            fraction *= step;
        }
        if (step - 1.0).abs() < 1e-15 {
            break;
        }
    }
    front * fraction
}

/// ln of the gamma function for x above 0: Stirling's series, moved to 8 or beyond, where its sixth term is below 3e-13.
fn ln_gamma(x: f64) -> f64 {
    let steps = (8.0 - x).ceil().max(0.0);
    let product: f64 = (0..steps as u32).map(|i| x + f64::from(i)).product();
    let z = x + steps;
    let w = 1.0 / (z * z);
    let series = (1.0 / 12.0 - w * (1.0 / 360.0 - w * (1.0 / 1260.0 - w * (1.0 / 1680.0 - w / 1188.0)))) / z;
    (z - 0.5) * z.ln() - z + 0.5 * std::f64::consts::TAU.ln() + series - product.ln()
}
