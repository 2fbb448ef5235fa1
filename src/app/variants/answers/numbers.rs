//! Numbers as users read them, and what follows from a record.

use std::collections::BTreeSet;

use crate::app::variants::record::{Answer, Record, Snapshot, State};

/// Three digits that say something: 0.0123, 4.56, 1230; by powers of ten where that would be long.
pub fn short(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    let digits = (2 - size.log10().floor() as i32).max(0) as usize;
    format!("{value:.digits$}")
}

/// A value for programs: as many digits as it has; nothing where there is none.
pub fn exact(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map(|value| format!("{value:e}")).unwrap_or_default()
}

/// 1 / (relMSE x seconds), by the film's own estimate of its error. None where either is not known.
pub fn efficiency(snapshot: &Snapshot) -> Option<f64> {
    let work = snapshot.relmse * snapshot.seconds;
    (work > 0.0 && work.is_finite()).then(|| 1.0 / work)
}

/// What a member is marked with: one word, and the rest of it.
pub fn state(record: &Record) -> (&'static str, String) {
    match &record.state {
        State::Done => ("done", String::new()),
        State::Failed { message, file, line, column } => ("failed", located(message, file.as_deref(), *line, *column)),
        State::Lost { seconds, confidence } => {
            let percent = rounded_down(*confidence);
            ("ended", format!("lost the race after {} s, with {percent} % confidence", short(*seconds)))
        }
        State::Missing => ("missing", "not rendered yet".to_owned()),
    }
}

/// Confidence in percent, never more than there is: 0.9996 is 99.9.
fn rounded_down(confidence: f64) -> String {
    let tenths = (confidence * 1000.0 + 1e-9).floor() / 10.0;
    format!("{tenths}")
}

fn located(message: &str, file: Option<&str>, line: u32, column: u32) -> String {
    match (file, line) {
        (Some(file), 0) => format!("{file}: {message}"),
        (Some(file), _) => format!("{file}:{line}:{column}: {message}"),
        (None, _) => message.to_owned(),
    }
}

/// Every path by which members differ, in the order of first use.
pub fn paths(answer: &Answer) -> Vec<&str> {
    let (mut paths, mut known): (Vec<&str>, BTreeSet<&str>) = Default::default();
    for (path, _) in answer.records.iter().flat_map(|record| &record.settings) {
        if known.insert(path) {
            paths.push(path);
        }
    }
    let differ = |path: &&str| {
        let mut values = answer.records.iter().map(|record| setting(record, path));
        let first = values.next();
        values.any(|value| Some(value) != first)
    };
    paths.retain(differ);
    paths
}

/// What a member sets a path to. The last one wins, as in the scene.
pub fn setting<'a>(record: &'a Record, path: &str) -> Option<&'a str> {
    record.settings.iter().rfind(|(own, _)| own == path).map(|(_, value)| value.as_str())
}
