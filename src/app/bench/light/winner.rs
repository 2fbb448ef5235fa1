//! Which configuration of a scene reached an error soonest, in a sentence.

use super::record::{Bench, ConfigurationRecord, SceneRecord, Snapshot};
use crate::app::shared::spread::spread;
use crate::stats::summary::Welch;

/// The probability at most with which two equal configurations are told apart.
const ALPHA: f64 = 0.01;

/// A sentence a scene that has more than one configuration.
pub fn sentences(bench: &Bench) -> String {
    bench.scenes.iter().filter_map(sentence).map(|sentence| sentence + "\n").collect()
}

/// Of one scene; none where there is nothing to compare.
fn sentence(scene: &SceneRecord) -> Option<String> {
    let mut ranked: Vec<(&ConfigurationRecord, f64, f64)> =
        scene.configurations.iter().filter_map(efficiency).collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    let [(best, first, first_error), (next, second, second_error), ..] = ranked[..] else { return None };
    let ratio = first / second;
    let error = ratio * (first_error / first).hypot(second_error / second);
    let (name, best_name, next_name) = (&scene.scene, &best.name, &next.name);
    let by = spread(ratio, error);
    let is_better = logs(best).zip(logs(next)).and_then(|(best, next)| Welch::of(&best, &next, 0.0));
    Some(match is_better.is_some_and(|test| test.p() < ALPHA / (ranked.len() - 1) as f64) {
        true => format!("{name}: {best_name} won, {by} times as efficient as {next_name}, the next."),
        false => format!("{name}: {best_name} and {next_name} can't be told apart: {by} times as efficient."),
    })
}

/// Mean and standard error of the efficiency with most samples.
fn efficiency(configuration: &ConfigurationRecord) -> Option<(&ConfigurationRecord, f64, f64)> {
    let summary = configuration.last()?.efficiency.as_ref()?;
    Some((configuration, summary.mean, summary.standard_error.unwrap_or(0.0)))
}

/// Logarithms of the same by seed.
fn logs(configuration: &ConfigurationRecord) -> Option<Vec<f64>> {
    let spp = configuration.last()?.spp;
    configuration.at(spp).map(Snapshot::efficiency).map(|value| value.map(f64::ln)).collect()
}
