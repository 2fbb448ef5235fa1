//! A benchmark against an earlier one: what became less efficient, by more than noise and tolerance.

use std::fmt::Write;
use std::path::Path;

use super::read::read_json;
use super::record::{Bench, ConfigurationRecord, SceneRecord, Snapshot};
use crate::app::bench::BenchError;
use crate::stats::summary::Welch;

/// Probability that anything at all is called worse, or better, though nothing changed.
const FAMILY_WISE: f64 = 1e-3;

/// What became of an efficiency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    Worse,
    Better,
    /// Within noise and tolerance.
    None,
}

/// One number of samples of one configuration of one scene. Ratios are now by then, of geometric means over the seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    pub scene: String,
    pub configuration: String,
    pub spp: u32,
    pub efficiency: f64,
    pub relmse: f64,
    pub seconds: f64,
    /// Probability of a loss, or of a gain if that is what it is, as large by chance.
    pub p: f64,
    pub change: Change,
}

/// All comparisons.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    pub comparisons: Vec<Comparison>,
    /// What could not be compared, or only with care.
    pub notes: Vec<String>,
}

/// Reads an earlier benchmark.
pub fn read(path: &Path) -> Result<Bench, BenchError> {
    read_json(path)
}

/// Compares what both have: log efficiency over the seeds, by Welch's test, one-sided in both directions. `tolerance` is
/// the part by which efficiency may differ without being called so.
pub fn compare(now: &Bench, then: &Bench, tolerance: f64) -> Verdict {
    let mut verdict = Verdict::default();
    if now.machine.adapter != then.machine.adapter {
        verdict
            .notes
            .push(format!("times are of another adapter: {}, before {}", now.machine.adapter, then.machine.adapter));
    }
    let mut tests = Vec::new();
    for scene in &now.scenes {
        let Some(earlier) = then.scenes.iter().find(|earlier| earlier.scene == scene.scene) else {
            verdict.notes.push(format!("{} was not measured before", scene.scene));
            continue;
        };
        if earlier.key != scene.key {
            verdict.notes.push(format!("{} was another picture before: not compared", scene.scene));
            continue;
        }
        compare_scene(scene, earlier, tolerance, &mut tests, &mut verdict.notes);
    }
    let limit = FAMILY_WISE / (2 * tests.len()).max(1) as f64;
    let decide = |(mut comparison, sign): (Comparison, Change)| {
        comparison.change = if comparison.p < limit { sign } else { Change::None };
        comparison
    };
    verdict.comparisons = tests.into_iter().map(decide).collect();
    verdict
}

fn compare_scene(
    scene: &SceneRecord,
    earlier: &SceneRecord,
    tolerance: f64,
    tests: &mut Vec<(Comparison, Change)>,
    notes: &mut Vec<String>,
) {
    for configuration in &scene.configurations {
        let name = &configuration.name;
        let Some(before) = earlier.configurations.iter().find(|before| before.name == *name) else {
            notes.push(format!("{}, {name} was not measured before", scene.scene));
            continue;
        };
        for snapshot in &configuration.snapshots {
            if before.at(snapshot.spp).next().is_none() {
                continue;
            }
            match test(configuration, before, snapshot.spp, tolerance) {
                Some((mut comparison, sign)) => {
                    comparison.scene.clone_from(&scene.scene);
                    tests.push((comparison, sign));
                }
                None => notes.push(format!(
                    "{}, {name} at {} spp: too few seeds, or a reference as noisy as they are",
                    scene.scene, snapshot.spp
                )),
            }
        }
    }
}

/// What the seeds say, and what that would be if it is more than noise.
fn test(
    now: &ConfigurationRecord,
    then: &ConfigurationRecord,
    spp: u32,
    tolerance: f64,
) -> Option<(Comparison, Change)> {
    let logs = |of: &ConfigurationRecord, value: fn(&Snapshot) -> Option<f64>| {
        of.at(spp).map(|snapshot| value(snapshot).map(f64::ln)).collect::<Option<Vec<f64>>>()
    };
    let ratio = |value: fn(&Snapshot) -> Option<f64>| {
        let mean = |of| logs(of, value).map(|logs| logs.iter().sum::<f64>() / logs.len() as f64);
        Some((mean(now)? - mean(then)?).exp())
    };
    let (new, old) = (logs(now, Snapshot::efficiency)?, logs(then, Snapshot::efficiency)?);
    let margin = tolerance.ln_1p();
    let loss = Welch::of(&old, &new, margin)?;
    let gain = Welch::of(&new, &old, margin)?;
    let (p, sign) = if loss.t > gain.t { (loss.p(), Change::Worse) } else { (gain.p(), Change::Better) };
    let comparison = Comparison {
        scene: String::new(),
        configuration: now.name.clone(),
        spp,
        efficiency: ratio(Snapshot::efficiency)?,
        relmse: ratio(|s| Some(s.relmse))?,
        seconds: ratio(|s| Some(s.seconds))?,
        p,
        change: Change::None,
    };
    Some((comparison, sign))
}

impl Verdict {
    /// Something was compared, and nothing is worse.
    pub fn passed(&self) -> bool {
        !self.comparisons.is_empty() && self.worse().next().is_none()
    }

    /// What became less efficient.
    pub fn worse(&self) -> impl Iterator<Item = &Comparison> {
        self.comparisons.iter().filter(|comparison| comparison.change == Change::Worse)
    }

    /// A table of all comparisons, and what is worse in words.
    pub fn markdown(&self) -> String {
        let mut text = String::from(
            "## Against an earlier run\n\nNow by then; above 1 is better for efficiency, worse for relMSE and seconds.\n\n",
        );
        text += "| scene | config | spp | efficiency | relMSE | seconds | p | |\n|---|---|--:|--:|--:|--:|--:|---|\n";
        for c in &self.comparisons {
            let change = match c.change {
                Change::Worse => "worse",
                Change::Better => "better",
                Change::None => "",
            };
            let _ = writeln!(
                text,
                "| {} | {} | {} | {:.3} | {:.3} | {:.3} | {:.0e} | {change} |",
                c.scene, c.configuration, c.spp, c.efficiency, c.relmse, c.seconds, c.p
            );
        }
        text.push('\n');
        for note in &self.notes {
            let _ = writeln!(text, "- {note}");
        }
        for c in self.worse() {
            let _ = writeln!(
                text,
                "- regression: {}, {} at {} spp: efficiency is {:.3} of what it was (p {:.0e}), relMSE {:.3}, seconds {:.3}",
                c.scene, c.configuration, c.spp, c.efficiency, c.p, c.relmse, c.seconds
            );
        }
        let worse = self.worse().count();
        let _ = match self.comparisons.len() {
            0 => writeln!(text, "- nothing could be compared"),
            all => writeln!(text, "- {worse} of {all} worse"),
        };
        text
    }
}
