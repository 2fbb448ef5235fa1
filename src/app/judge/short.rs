//! What an analysis says, in the few words that a row of a list has room for.

use super::analysis::{Analysis, Unknown, Verdict, part, times};
use crate::stats::efficiency::Ratio;

impl Analysis {
    /// The verdict of films that are all there are.
    pub fn short(&self) -> String {
        match &self.verdict {
            Verdict::Differ if self.means.whole.differs => {
                format!("DIFFERS by {}", part(self.means.whole.relative.abs()))
            }
            Verdict::Differ => format!("DIFFERS by up to {} in places", part(self.most_differing())),
            Verdict::Agree(agreement) => {
                format!("agrees within {}, {}", part(self.agrees_within()), efficiency(agreement.ratio()))
            }
            Verdict::CannotTell(Unknown::Black) => "can't tell: black by both".to_owned(),
            Verdict::CannotTell(Unknown::TooFew) => format!("can't tell: {} films are too few", self.films),
            Verdict::CannotTell(Unknown::Coarse) => match self.means.least_found {
                Some(least) => format!("can't tell: nothing below {} would show", part(least)),
                None => "can't tell: too much noise".to_owned(),
            },
        }
    }

    /// What can be said while there are more films to come.
    pub fn so_far(&self) -> String {
        match self.means.least_found {
            _ if self.means.differ() => self.short(),
            Some(least) => format!("no difference above {} yet", part(least)),
            None => "nothing can be told yet".to_owned(),
        }
    }

    /// By how much the block differs that differs most, relative.
    fn most_differing(&self) -> f64 {
        self.means.differing().map(|block| block.relative.abs()).fold(0.0, f64::max)
    }
}

fn efficiency(ratio: Option<Ratio>) -> String {
    match ratio {
        None => "no noise to compare".to_owned(),
        Some(Ratio { ratio, low, .. }) if low > 1.0 => format!("{}x more efficient", times(ratio)),
        Some(Ratio { ratio, high, .. }) if high < 1.0 => format!("{}x less efficient", times(1.0 / ratio)),
        Some(_) => "as efficient".to_owned(),
    }
}
