//! What an analysis of the films so far has shown.

use glam::UVec2;

use super::series::Estimator;
use crate::app::shared::progress::clock;
use crate::stats::efficiency::Ratio;
use crate::stats::equal_means::{Difference, LEAST_GROUPS, Means};

/// A difference that is found by this part of what was wanted is small enough to end early.
const FAR_BELOW: f64 = 0.2;

/// Why no more films are needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The means differ.
    Differ,
    /// Means agree closely, and the ratio of the efficiencies is known well enough.
    Narrow,
    /// The time is over.
    Time,
    /// There are as many films as were wanted.
    Films,
}

/// What the films say. Of efficiency only where means agree: a wrong estimator has none.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// The means differ.
    Differ,
    /// Neither that nor that they agree.
    CannotTell(Unknown),
    /// They were not found to differ, though a difference as small as was wanted would have been.
    Agree(Agreement),
}

/// Why nothing is known of the means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// There are fewer films than the test needs.
    TooFew,
    /// No film has any light.
    Black,
    /// Only larger differences would have been found than was wanted.
    Coarse,
}

/// What equal means allow to be said. [`Verdict::of`] alone makes one.
#[derive(Clone, Debug)]
pub struct Agreement {
    ratio: Option<Ratio>,
    estimators: [Estimator; 2],
}

impl Agreement {
    /// Efficiency of the new by that of the old; `None` where films have no noise.
    pub fn ratio(&self) -> Option<Ratio> {
        self.ratio
    }

    /// The old one first.
    pub fn estimators(&self) -> &[Estimator; 2] {
        &self.estimators
    }
}

impl Verdict {
    /// By an analysis of the means, the least difference of the whole picture that was to be found, and the numbers that are to be reported
    /// only where it would have been.
    pub fn of(means: &Means, within: f64, ratio: Option<Ratio>, estimators: [Estimator; 2]) -> Self {
        match means.least_found {
            _ if means.differ() => Self::Differ,
            _ if means.spent == 0.0 => Self::CannotTell(Unknown::TooFew),
            Some(least) if least <= within => Self::Agree(Agreement { ratio, estimators }),
            _ if means.black => Self::CannotTell(Unknown::Black),
            _ => Self::CannotTell(Unknown::Coarse),
        }
    }
}

/// All films so far.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Of each.
    pub films: usize,
    /// Samples a pixel of a film.
    pub spp: u32,
    /// Pixels of a film.
    pub size: UVec2,
    pub means: Means,
    /// The least difference of the whole picture that was to be found, relative.
    pub within: f64,
    pub verdict: Verdict,
    /// Samples that were no numbers, or too large, and were left out; of all films of the old one, and of the new.
    pub bad_samples: [u64; 2],
    /// Wall clock since the beginning, and what of it the films took.
    pub seconds: [f64; 2],
    pub ended: Option<End>,
}

impl Analysis {
    /// The verdict in one line.
    pub fn line(&self) -> String {
        match &self.verdict {
            Verdict::Differ => self.difference(),
            Verdict::Agree(agreement) => format!("{}; {}", efficiency(agreement.ratio), self.agreement()),
            Verdict::CannotTell(Unknown::Black) => "can't tell: the picture is black by both".to_owned(),
            Verdict::CannotTell(Unknown::TooFew) => self.too_few(),
            Verdict::CannotTell(Unknown::Coarse) => format!("can't tell: {}", self.power()),
        }
    }

    /// Whether a difference would have been found that is far smaller than was wanted.
    pub fn is_fine(&self) -> bool {
        let fine = |least| least <= FAR_BELOW * self.within;
        matches!(self.verdict, Verdict::Agree(_)) && self.means.least_found.is_some_and(fine)
    }

    /// The wall clock by which a difference as small as this would be found, seconds; `None` where nothing is known of that.
    /// Errors fall with the root of the number of films.
    pub fn seconds_to_find(&self, relative: f64) -> Option<f64> {
        let [seconds, films] = self.seconds;
        let times = (self.means.least_found? / relative).powi(2);
        Some(seconds - films + films * times)
    }

    /// The least difference that would have been found by now, and when a smaller one would be: the wanted one, or half.
    fn power(&self) -> String {
        let Some(least) = self.means.least_found else {
            return "no difference of the whole picture would have been found yet, however large".to_owned();
        };
        let next = if least > self.within { self.within } else { 0.5 * least };
        let later =
            self.seconds_to_find(next).map_or(String::new(), |at| format!("; {} takes {}", part(next), clock(at)));
        let now = clock(self.seconds[0].round().max(1.0));
        format!("a difference of at least {} of the whole picture would have been found in {now}{later}", part(least))
    }

    fn too_few(&self) -> String {
        let (films, size) = (self.films, self.size);
        let later = match films {
            0 => format!(
                "the first were not finished after {}, compiling included",
                clock(self.seconds[0].round().max(1.0))
            ),
            _ => {
                let [seconds, taken] = self.seconds;
                let all = seconds - taken + taken * LEAST_GROUPS as f64 / films as f64;
                format!("{LEAST_GROUPS} take {}", clock(all))
            }
        };
        format!("can't tell: {films} films of each at {}x{} are too few to tell of means; {later}", size.x, size.y)
    }

    /// How well the means are known to agree: two standard errors of the whole picture, and what would have been found.
    fn agreement(&self) -> String {
        format!("means agree, the whole picture's within {}; {}", part(self.agrees_within()), self.power())
    }

    /// What the whole picture's means differ by at most: by what was found and two standard errors, relative.
    pub(super) fn agrees_within(&self) -> f64 {
        let whole = &self.means.whole;
        let error = whole.standard_error.unwrap_or(0.0);
        (whole.difference.abs() + 2.0 * error) / whole.old.max(f64::MIN_POSITIVE)
    }

    fn difference(&self) -> String {
        let (whole, count) = (&self.means.whole, self.means.differing().count());
        let size = |block: &&Difference| block.relative.abs();
        let most = self.means.differing().max_by(|a, b| size(a).total_cmp(&size(b)));
        let mut parts = Vec::new();
        if let Some(most) = most {
            parts.push(format!("{count} of {} blocks, by up to {}", self.means.blocks.len(), change(most)));
        }
        if whole.differs {
            parts.push(format!("the whole picture by {}", change(whole)));
        }
        let places = || self.means.differing().chain(Some(whole).filter(|whole| whole.differs));
        let how = match (places().any(|p| p.difference > 0.0), places().any(|p| p.difference < 0.0)) {
            _ if places().all(|place| place.coloured) => "the new one has other colours",
            (true, false) => "the new one is brighter",
            (false, true) => "the new one is darker",
            _ => "the new one is brighter here and darker there",
        };
        format!("means differ: {}; {how}", parts.join(", "))
    }
}

fn efficiency(ratio: Option<Ratio>) -> String {
    let Some(Ratio { ratio, low, high }) = ratio else {
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

/// A factor, with the digits that count.
pub(super) fn times(value: f64) -> String {
    match value {
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

/// A part of something, without a sign, by two digits at least.
pub(super) fn part(relative: f64) -> String {
    match 100.0 * relative {
        v if v >= 9.95 => format!("{v:.0} %"),
        v if v >= 0.995 => format!("{v:.1} %"),
        v if v >= 0.0995 => format!("{v:.2} %"),
        v => format!("{v:.3} %"),
    }
}

/// A change of a place's mean, and in which colour, if not in all.
fn change(at: &Difference) -> String {
    let percent = 100.0 * at.relative;
    let amount = if percent.abs() < 1.0 { format!("{percent:+.2} %") } else { format!("{percent:+.1} %") };
    let colour = if at.coloured { [" of red", " of green", " of blue"][at.channel] } else { "" };
    format!("{amount}{colour}")
}
