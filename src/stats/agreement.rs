//! Whether two estimators have one mean, by batches of as many samples of each.

/// Batches behind each standard error.
pub const BATCHES: usize = 32;

/// Standard errors that a difference may reach. Student's t with 31 degrees of freedom is beyond 6.4 with a probability of
/// 4e-7: a family of 250 comparisons fails falsely with 1e-4.
pub const MOST_ERRORS: f64 = 6.4;

/// Part of the mean by which rounding alone may move one of two estimators.
const ROUNDING: f64 = 1e-5;

/// Part of the mean above which a standard error proves nothing.
pub const MOST_NOISE: f64 = 0.003;

/// One estimate a batch by each of two estimators, for one block of pixels and one channel.
pub struct Pairs {
    pub differences: [f64; BATCHES],
    /// Mean of the one that is right.
    pub mean: f64,
}

/// How well two estimators agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// What of the difference is beyond rounding, in standard errors.
    pub errors: f64,
    /// The standard error by the mean.
    pub noise: f64,
    /// Mean of one less mean of the other.
    pub difference: f64,
    pub mean: f64,
}

impl Pairs {
    pub fn agreement(&self) -> Agreement {
        let n = BATCHES as f64;
        let difference = self.differences.iter().sum::<f64>() / n;
        let squares = self.differences.iter().map(|d| (d - difference).powi(2)).sum::<f64>();
        let error = (squares / (n - 1.0) / n).sqrt();
        let beyond = difference.abs() - ROUNDING * self.mean;
        // Of no light at all there is no noise.
        let noise = if error == 0.0 { 0.0 } else { error / self.mean };
        Agreement { errors: if beyond <= 0.0 { 0.0 } else { beyond / error }, noise, difference, mean: self.mean }
    }
}

impl Agreement {
    /// Of nothing.
    pub const PERFECT: Self = Self { errors: 0.0, noise: 0.0, difference: 0.0, mean: 0.0 };

    /// The greater disagreement of two, and the greater noise; NaN is the greatest.
    pub fn worst(self, other: Self) -> Self {
        let worse = if is_beaten(self.errors, other.errors) { other } else { self };
        let noise = if is_beaten(self.noise, other.noise) { other.noise } else { self.noise };
        Self { noise, ..worse }
    }

    /// Whether |difference| <= z * se + 1e-5 * mean, with se below 0.3 % of the mean; what is wrong if not.
    pub fn check(&self) -> Result<(), String> {
        let Self { errors, noise, difference, mean } = self;
        match (*noise <= MOST_NOISE, *errors <= MOST_ERRORS) {
            (true, true) => Ok(()),
            (false, _) => Err(format!("a standard error of {noise:e} of the mean {mean:e} proves nothing")),
            _ => Err(format!("differ by {difference:e}, {errors:.1} standard errors, of a mean of {mean:e}")),
        }
    }
}

/// Whether the second of two numbers is greater, or no number; nothing beats what is no number, of either sign.
pub fn is_beaten(number: f64, other: f64) -> bool {
    !number.is_nan() && (other.is_nan() || other > number)
}

/// The greatest of numbers that are not negative, or what is no number among them.
pub fn greatest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |most, number| if is_beaten(most, number) { number } else { most })
}

/// Whether two estimators agree; what is wrong if not.
pub fn agree(pairs: &Pairs) -> Result<(), String> {
    pairs.agreement().check()
}
