//! A verdict as text, and as JSON.

use std::path::Path;

use serde_json::{Value, json};

use super::analysis::{Analysis, End, Unknown, Verdict};
use super::arguments::JudgeArguments;
use super::series::Estimator;
use crate::components::Film;
use crate::stats::equal_means::Difference;
use crate::stats::sign_flips::MISSED;

/// All there is to say.
pub struct JudgeSummary<'a> {
    pub arguments: &'a JudgeArguments,
    /// What the shaders are called, the old ones first.
    pub names: &'a [String; 2],
    /// The scene file.
    pub path: &'a Path,
    /// Its name.
    pub scene: &'a str,
    /// As it was traced last.
    pub film: Film,
    pub adapter: String,
    /// Whether the scene runs other code than before.
    pub changed: bool,
    pub analysis: &'a Analysis,
}

/// Of code that is the same, where nothing was traced.
pub fn unchanged(text: &str, json: bool) -> String {
    match json {
        true => format!("{}\n", json!({ "verdict": text, "changed": false })),
        false => format!("{text}\n"),
    }
}

impl JudgeSummary<'_> {
    pub fn json(&self, outputs: &[String]) -> Value {
        let (analysis, means) = (self.analysis, &self.analysis.means);
        let agreement = match &analysis.verdict {
            Verdict::Agree(agreement) => Some(agreement),
            Verdict::Differ | Verdict::CannotTell(_) => None,
        };
        let estimator = |which: usize| {
            let known = agreement.map(|agreement| agreement.estimators()[which]);
            estimator(known, analysis.bad_samples[which])
        };
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": self.scene,
            "scene_file": self.path.display().to_string(),
            "adapter": self.adapter,
            "old_shaders": self.names[0],
            "new_shaders": self.names[1],
            "size": analysis.size.to_array(),
            "seed": self.arguments.seed,
            "spp": analysis.spp,
            "films": analysis.films,
            "seconds": analysis.seconds[0],
            "changed": self.changed,
            "verdict": analysis.line(),
            "ended": analysis.ended.map_or("interrupted", |end| match end {
                End::Differ => "means differ",
                End::Narrow => "efficiency is known",
                End::Time => "time is over",
                End::Films => "all films are traced",
            }),
            // Null where means differ or can't be compared, and where films have no noise.
            "efficiency": agreement.and_then(|agreement| agreement.ratio()).map(|ratio| {
                json!({ "ratio": ratio.ratio, "low": ratio.low, "high": ratio.high })
            }),
            "old": estimator(0),
            "new": estimator(1),
            "means": {
                "told": !matches!(analysis.verdict, Verdict::CannotTell(_)),
                "differ": means.differ(),
                "alpha": self.arguments.alpha,
                "alpha_of_look": means.spent,
                // The least difference of the whole picture that would have been found, with this probability.
                "least_found": means.least_found,
                "probability": 1.0 - MISSED,
                "within": analysis.within,
                "seconds_to_within": analysis.seconds_to_find(analysis.within),
                "whole": difference(&means.whole),
                "blocks": means.blocks.len(),
                "differing": means.differing().map(difference).collect::<Vec<_>>(),
            },
            "outputs": outputs,
        })
    }

    /// The verdict, and what it rests on.
    pub fn text(&self, outputs: &[String]) -> String {
        let (analysis, size) = (self.analysis, self.analysis.size);
        let mut text = format!(
            "{}\n  {}: {} films of each by turns, {} spp, {}x{}\n",
            analysis.line(),
            self.scene,
            analysis.films,
            analysis.spp,
            size.x,
            size.y,
        );
        if let Verdict::Agree(agreement) = &analysis.verdict {
            let [old, new] = agreement.estimators();
            text += &format!(
                "  a film's relMSE {:.2e} -> {:.2e}, its time {:.1} -> {:.1} ms\n",
                old.relmse,
                new.relmse,
                1e3 * old.seconds,
                1e3 * new.seconds,
            );
        }
        for output in outputs {
            text += &format!("  {output}\n");
        }
        text
    }

    /// What was left out of the films, and what to do about too few of them.
    pub fn warnings(&self) -> Vec<String> {
        let named = ["old", "new"].into_iter().zip(self.analysis.bad_samples);
        let bad = named.filter(|(_, count)| *count > 0).map(|(name, count)| {
            format!("warning: {count} samples of the {name} one were no numbers, or too large, and were left out")
        });
        bad.chain(self.help()).collect()
    }

    fn help(&self) -> Option<String> {
        let longer = match self.analysis.ended {
            Some(End::Films) => "more --films",
            _ => "more --time",
        };
        match &self.analysis.verdict {
            Verdict::CannotTell(Unknown::TooFew) => {
                Some(format!("help: give {longer}, a smaller --size or fewer --spp"))
            }
            Verdict::CannotTell(Unknown::Coarse) => Some(format!(
                "help: give {longer}, or have efficiency told by a weaker test with a larger --within PERCENT (now {})",
                100.0 * self.analysis.within
            )),
            Verdict::CannotTell(Unknown::Black) => Some("help: give a --camera that sees light".to_owned()),
            Verdict::Differ | Verdict::Agree(_) => None,
        }
    }

    /// For the files.
    pub fn metadata(&self) -> Vec<(&'static str, String)> {
        vec![
            ("Software", concat!("Lucerna ", env!("CARGO_PKG_VERSION")).to_owned()),
            ("scene", self.path.display().to_string()),
            ("old", self.names[0].clone()),
            ("new", self.names[1].clone()),
            ("verdict", self.analysis.line()),
        ]
    }
}

/// Its numbers are null where nothing is to be said of efficiency.
fn estimator(known: Option<Estimator>, bad_samples: u64) -> Value {
    let (relmse, seconds) = known.map(|known| (known.relmse, known.seconds)).unzip();
    json!({ "relmse": relmse, "seconds": seconds, "bad_samples": bad_samples })
}

fn difference(at: &Difference) -> Value {
    let channel = ["red", "green", "blue"][at.channel];
    json!({
        "block": [at.min.x, at.max.x, at.min.y, at.max.y],
        "channel": channel,
        "old": at.old,
        "difference": at.difference,
        "standard_error": at.standard_error,
        "relative": at.relative,
        "p": at.p,
        "differs": at.differs,
    })
}
