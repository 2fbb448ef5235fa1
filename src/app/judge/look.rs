//! What a look at the films so far has shown.

use crate::cpu::efficiency::Ratio;
use crate::cpu::equal_means::{Difference, Means};

/// Why no more films are needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The means differ.
    Differ,
    /// The ratio of the efficiencies is known well enough.
    Narrow,
    /// The time is over.
    Time,
    /// There are as many films as were asked for.
    Films,
}

/// What films say of one estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    /// Of one film.
    pub relmse: f64,
    /// Of tracing one film.
    pub seconds: f64,
    /// Samples that were no numbers, or too large, and were left out; of all films.
    pub bad_samples: u64,
}

/// All films so far.
#[derive(Clone, Debug)]
pub struct Look {
    /// Of each.
    pub films: usize,
    /// Samples a pixel of a film.
    pub spp: u32,
    pub means: Means,
    /// Efficiency of the new by that of the old; `None` where films have no noise, or there are fewer than four.
    pub ratio: Option<Ratio>,
    pub old: Estimator,
    pub new: Estimator,
    pub ended: Option<End>,
}

impl Look {
    /// The verdict in one line.
    pub fn line(&self) -> String {
        match self.means.differ() {
            true => self.difference(),
            false => format!("{}; {}", self.efficiency(), self.agreement()),
        }
    }

    /// Whether there are films enough to say anything of means.
    pub fn tells(&self) -> bool {
        self.means.spent > 0.0
    }

    fn efficiency(&self) -> String {
        let Some(Ratio { ratio, low, high }) = self.ratio else {
            return "no noise to compare".to_owned();
        };
        match (low > 1.0, high < 1.0) {
            (true, _) => format!("{}x ({} to {}) more efficient", times(ratio), times(low), times(high)),
            (_, true) => {
                let [ratio, low, high] = [1.0 / ratio, 1.0 / high, 1.0 / low].map(times);
                format!("{ratio}x ({low} to {high}) less efficient")
            }
            _ => format!("{}x ({} to {}) as efficient: not told apart", times(ratio), times(low), times(high)),
        }
    }

    /// How well the means are known to agree: two standard errors of the whole picture.
    fn agreement(&self) -> String {
        let whole = &self.means.whole;
        match whole.standard_error {
            _ if !self.tells() => format!("{} films of each are too few to tell of means", self.films),
            Some(error) if whole.old > 0.0 => {
                let most = whole.difference.abs() + 2.0 * error;
                format!("means agree, the whole picture's within {:.2} %", 100.0 * most / whole.old)
            }
            _ => "means agree".to_owned(),
        }
    }

    fn difference(&self) -> String {
        let (whole, count) = (&self.means.whole, self.means.differing().count());
        let size = |block: &&Difference| block.relative.abs();
        let most = self.means.differing().max_by(|a, b| size(a).total_cmp(&size(b)));
        let mut parts = Vec::new();
        if let Some(most) = most {
            parts.push(format!("{count} of {} blocks, by up to {}", self.means.blocks.len(), percent(most.relative)));
        }
        if whole.differs {
            parts.push(format!("the whole picture by {}", percent(whole.relative)));
        }
        let places = || self.means.differing().chain(Some(whole).filter(|whole| whole.differs));
        let how = match (places().any(|p| p.difference > 0.0), places().any(|p| p.difference < 0.0)) {
            (true, false) => "the new one is brighter",
            (false, true) => "the new one is darker",
            _ => "the new one is brighter here and darker there",
        };
        format!("means differ: {}; {how}", parts.join(", "))
    }
}

/// A factor, with the digits that count.
fn times(value: f64) -> String {
    match value {
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

fn percent(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent.abs() < 1.0 { format!("{percent:+.2} %") } else { format!("{percent:+.1} %") }
}
