//! A scene's error against time, and against samples: a line a configuration, with a band from the least to the greatest seed.

use super::record::{Bench, ConfigurationRecord, SceneRecord, SnapshotSummary};
pub use crate::app::shared::plot::Axis;
use crate::app::shared::plot::{self, Line};

/// Letters of the adapter's name that there is room for.
const ADAPTER: usize = 46;

/// The file of a scene's plot.
pub fn file_name(scene: &SceneRecord, axis: Axis) -> String {
    match axis {
        Axis::Seconds => format!("{}-seconds.svg", scene.scene),
        Axis::Samples => format!("{}-spp.svg", scene.scene),
    }
}

/// The plot of a scene; none where no error is above 0.
pub fn svg(bench: &Bench, scene: &SceneRecord, axis: Axis) -> Option<String> {
    let lines = scene.configurations.iter().map(|configuration| line(configuration, axis)).collect();
    plot::svg(&scene.scene, &about(bench, scene), lines, axis)
}

fn line(configuration: &ConfigurationRecord, axis: Axis) -> Line {
    let x = |snapshot: &SnapshotSummary| match axis {
        Axis::Seconds => snapshot.seconds.mean,
        Axis::Samples => f64::from(snapshot.spp),
    };
    let point = |s: &SnapshotSummary| (x(s), s.relmse.mean, s.relmse.min, s.relmse.max);
    Line { name: configuration.name.clone(), points: configuration.snapshots.iter().map(point).collect() }
}

fn about(bench: &Bench, scene: &SceneRecord) -> String {
    let [width, height] = scene.size;
    let seeds = if bench.seeds == 1 { "1 seed".to_owned() } else { format!("{} seeds", bench.seeds) };
    let adapter = shortened(&bench.machine.adapter, ADAPTER);
    format!("{width} × {height} pixels, depth {}, {seeds}; {adapter}", scene.max_depth)
}

/// As many letters of a text, the last of them an ellipsis if there are more.
fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}
