//! A benchmark as a flat file for programs, and as tables for users.

use std::fmt::Write;

use super::record::{Bench, ConfigurationRecord, SceneRecord, SnapshotSummary};
use super::winner;
use crate::app::shared::csv::field;
use crate::app::shared::spread::{short, spread as with_spread};
use crate::stats::summary::{Crossing, Summary};

/// A row a snapshot of every seed. Where there is no number, the field is empty.
pub fn csv(bench: &Bench) -> String {
    let mut text = String::from("scene,config,seed,spp,seconds,rays,relmse,claimed,efficiency\n");
    let number = |value: Option<f64>| value.map(|value| format!("{value:e}")).unwrap_or_default();
    for scene in &bench.scenes {
        for configuration in &scene.configurations {
            for run in &configuration.runs {
                for s in &run.snapshots {
                    let (claimed, efficiency) = (number(s.claimed), number(s.efficiency()));
                    let _ = writeln!(
                        text,
                        "{},{},{},{},{:e},{},{:e},{claimed},{efficiency}",
                        field(&scene.scene),
                        configuration.name,
                        run.seed,
                        s.spp,
                        s.seconds,
                        s.rays,
                        s.relmse
                    );
                }
            }
        }
    }
    text
}

/// Two tables: each configuration at its last snapshot, and all snapshots.
pub fn markdown(bench: &Bench) -> String {
    let machine = &bench.machine;
    let mut text = format!(
        "# Error against time\n\nLucerna {}; {}; {} {}, {} threads; {} seeds.{}\n\n",
        bench.version,
        machine.adapter,
        machine.os,
        machine.architecture,
        machine.threads,
        bench.seeds,
        if bench.interrupted { " Ended early: not all was measured." } else { "" },
    );
    text += "Mean ± standard error over the seeds. Time is wall clock, of the batches alone. Efficiency is 1 / (relMSE x seconds); \
             the slope is that of log relMSE against log spp.\n\n";
    text += "| scene | config | spp | relMSE | relMSE x spp | seconds | Mrays/s | efficiency | slope | seconds to 1e-3 |\n\
             |---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (scene, configuration) in rows(bench) {
        if let Some(last) = configuration.last() {
            text += &summary_row(scene, configuration, last);
        }
    }
    text += "\n";
    text += &winner::sentences(bench);
    text += "\n## By samples\n\nClaimed / true is what the films say of their own error by what it is.\n\n\
             | scene | config | spp | relMSE | min | max | seconds | efficiency | claimed / true |\n\
             |---|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (scene, configuration) in rows(bench) {
        for snapshot in &configuration.snapshots {
            text += &snapshot_row(scene, configuration, snapshot);
        }
    }
    text + "\n" + &references(bench)
}

fn rows(bench: &Bench) -> impl Iterator<Item = (&SceneRecord, &ConfigurationRecord)> {
    bench.scenes.iter().flat_map(|scene| scene.configurations.iter().map(move |configuration| (scene, configuration)))
}

fn summary_row(scene: &SceneRecord, configuration: &ConfigurationRecord, last: &SnapshotSummary) -> String {
    let slope = configuration.slope.map_or("-".to_owned(), |slope| match slope.standard_error {
        Some(error) => with_spread(slope.slope, error),
        None => format!("{:.3}", slope.slope),
    });
    // Of a peer's rays nothing is known.
    let rays = match last.rays_per_second {
        0.0 => "-".to_owned(),
        rays => format!("{:.2}", rays * 1e-6),
    };
    let reach = match configuration.reach() {
        Some(Crossing::At(seconds)) => short(seconds),
        Some(Crossing::Before(seconds)) => format!("< {}", short(seconds)),
        Some(Crossing::After(seconds)) => format!("> {}", short(seconds)),
        None => "-".to_owned(),
    };
    format!(
        "| {} | {} | {} | {}{} | {} | {} | {rays} | {} | {slope} | {reach} |\n",
        scene.scene,
        configuration.name,
        last.spp,
        spread(&last.relmse),
        doubt(scene, last),
        short(last.relmse.mean * f64::from(last.spp)),
        spread(&last.seconds),
        last.efficiency.as_ref().map_or("-".to_owned(), spread),
    )
}

fn snapshot_row(scene: &SceneRecord, configuration: &ConfigurationRecord, snapshot: &SnapshotSummary) -> String {
    format!(
        "| {} | {} | {} | {}{} | {} | {} | {} | {} | {} |\n",
        scene.scene,
        configuration.name,
        snapshot.spp,
        spread(&snapshot.relmse),
        doubt(scene, snapshot),
        short(snapshot.relmse.min),
        short(snapshot.relmse.max),
        spread(&snapshot.seconds),
        snapshot.efficiency.as_ref().map_or("-".to_owned(), spread),
        snapshot.claimed_over_true.map_or("-".to_owned(), |ratio| format!("{ratio:.2}")),
    )
}

/// What errors were taken against, and what is wrong with it.
fn references(bench: &Bench) -> String {
    let mut text = String::new();
    for scene in &bench.scenes {
        let reference = &scene.reference;
        let [width, height] = scene.size;
        let _ = writeln!(
            text,
            "- {}: {width}x{height}, depth {}, {} triangles; reference by {} with {} spp, its own relMSE of {:.2e} subtracted.",
            scene.scene, scene.max_depth, scene.triangles, reference.by, reference.spp, reference.relmse
        );
        let bad: u64 = scene.configurations.iter().map(|configuration| configuration.bad_samples).sum();
        if bad > 0 {
            let _ =
                writeln!(text, "- {}: {bad} samples were no numbers, or too large, and were left out.", scene.scene);
        }
    }
    let doubtful =
        |(scene, c): (&SceneRecord, &ConfigurationRecord)| c.snapshots.iter().any(|s| !doubt(scene, s).is_empty());
    if rows(bench).any(doubtful) {
        text += "- \\*: the reference's own relMSE is more than a tenth of this; give it a larger --reference-spp.\n";
    }
    text
}

fn doubt(scene: &SceneRecord, snapshot: &SnapshotSummary) -> &'static str {
    if scene.is_doubtful(snapshot.relmse.mean) { "\\*" } else { "" }
}

/// Mean and standard error.
fn spread(summary: &Summary) -> String {
    with_spread(summary.mean, summary.standard_error.unwrap_or(0.0))
}
