//! Who reached an error sooner, and by how much: run by run, so that what slows both down counts for neither.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use super::references::Agreement;
use crate::app::bench::light::record::{ConfigurationRecord, Run};
use crate::app::shared::spread::{short, spread};
use crate::stats::summary::{Crossing, crossing};

/// A median with the least and the greatest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    pub median: f64,
    pub least: f64,
    pub most: f64,
}

/// The way to one error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    pub relmse: f64,
    /// Seconds of Lucerna and of the peer; none where a run was there from its first samples on, or never.
    pub seconds: [Option<Spread>; 2],
    /// How many times as long the peer takes, by runs that were made by turns.
    pub ratio: Option<Spread>,
}

/// One configuration beside the peer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beside {
    pub configuration: String,
    pub levels: Vec<Level>,
}

/// What came of a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Verdict {
    pub scene: String,
    /// `mitsuba 3.9.1, llvm_ad_rgb`.
    pub peer: String,
    pub agreement: Agreement,
    /// How the exported scene differs.
    pub notes: Vec<String>,
    /// Nothing where the references don't agree.
    pub beside: Vec<Beside>,
}

impl Spread {
    /// None without values.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let (least, most) = (*values.first()?, *values.last()?);
        let median = 0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2]);
        Some(Self { median, least, most })
    }
}

/// Errors that are looked at: powers of ten, and the last.
pub fn levels(to: f64) -> Vec<f64> {
    let powers = (1..=6).map(|power| 10f64.powi(-power)).filter(|level| *level > to * 1.001);
    powers.chain([to]).collect()
}

/// Compares a configuration with the peer, down to an error.
pub fn beside(ours: &ConfigurationRecord, theirs: &ConfigurationRecord, to: f64) -> Beside {
    let level = |relmse: f64| {
        let times = |of: &ConfigurationRecord| of.runs.iter().map(|run| seconds(run, relmse)).collect::<Vec<_>>();
        let (ours, theirs) = (times(ours), times(theirs));
        let ratios: Option<Vec<f64>> = ours.iter().zip(&theirs).map(|(a, b)| Some((*b)? / (*a)?)).collect();
        let spread = |times: Vec<Option<f64>>| times.into_iter().collect::<Option<Vec<_>>>().and_then(Spread::of);
        Level { relmse, seconds: [spread(ours), spread(theirs)], ratio: ratios.and_then(Spread::of) }
    };
    Beside { configuration: ours.name.clone(), levels: levels(to).into_iter().map(level).collect() }
}

/// When a run came to an error.
fn seconds(run: &Run, relmse: f64) -> Option<f64> {
    let points: Vec<(f64, f64)> = run.snapshots.iter().map(|s| (s.seconds, s.relmse)).collect();
    match crossing(&points, relmse)? {
        Crossing::At(seconds) => Some(seconds),
        Crossing::Before(_) | Crossing::After(_) => None,
    }
}

/// A table of all scenes, and what there is to say of each.
pub fn markdown(verdicts: &[Verdict]) -> String {
    let mut text = String::from(
        "Median of the runs (least to most). The ratio is that of the peer's time to Lucerna's, run by run: above 1, Lucerna is there sooner. \
         `-` is a level that lies outside of what was rendered.\n\n\
         | scene | config | relMSE | Lucerna, s | peer, s | ratio |\n|---|---|--:|--:|--:|--:|\n",
    );
    let cell = |spread: &Option<Spread>| match spread {
        Some(s) => format!("{} ({} to {})", short(s.median), short(s.least), short(s.most)),
        None => "-".to_owned(),
    };
    for verdict in verdicts {
        for beside in &verdict.beside {
            for Level { relmse, seconds: [ours, theirs], ratio } in &beside.levels {
                let (scene, name) = (&verdict.scene, &beside.configuration);
                let cells = [cell(ours), cell(theirs), cell(ratio)].join(" | ");
                let _ = writeln!(text, "| {scene} | {name} | {relmse:.0e} | {cells} |");
            }
        }
    }
    text.push('\n');
    verdicts.iter().for_each(|verdict| text += &verdict.sentence());
    text
}

impl Verdict {
    /// Whether the references agree, and what was written otherwise.
    pub fn sentence(&self) -> String {
        let Agreement { noise: [ours, theirs], difference, standard_error, mean, agree } = self.agreement;
        let (scene, peer) = (&self.scene, &self.peer);
        let found = format!(
            "beyond their noise (relMSE {} and {}) they differ by {}; the whole picture by {:+.3} %",
            short(ours),
            short(theirs),
            spread(difference, standard_error),
            mean * 100.0
        );
        let text = match agree {
            true => format!("the references of Lucerna and {peer} agree"),
            false if difference < 3.0 * standard_error => {
                format!(
                    "no verdict: the references of Lucerna and {peer} are too noisy, give them a larger --reference-spp"
                )
            }
            false => format!("no verdict: the references of Lucerna and {peer} are not the same picture"),
        };
        let mut text = format!("{scene}: {text}: {found}.\n");
        self.notes.iter().for_each(|note| text += &format!("  {note}\n"));
        text
    }
}
