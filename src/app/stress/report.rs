//! The table as text, and as JSON.

use std::time::Instant;

use serde_json::{Value, json};

use crate::stress::planted::caught;
use crate::stress::{Measured, Outcome, Row, Scale, StressError, Verdict};

/// What is said once.
pub struct Head {
    pub adapter: String,
    pub scale: Scale,
    pub begin: Instant,
}

/// A mistake, and what the rows that are to see it say.
pub struct Planted<'a> {
    pub name: &'a str,
    pub wrong: &'a str,
    pub outcomes: Result<Vec<Outcome>, StressError>,
}

/// What a row is about.
pub fn list(rows: &[&Row]) -> String {
    let entry = |row: &&Row| {
        let [_, quick, full] = row.sizes.map(|size| figure(size as f64));
        let (name, holds, quantity, unit) = (row.name, row.holds, row.quantity, row.unit);
        format!("{name}\n    {holds}\n    {quantity}: at most {}; {quick} {unit}, --full {full}\n", figure(row.most))
    };
    rows.iter().map(entry).collect()
}

/// What comes before all rows.
pub fn head(head: &Head) -> String {
    let sizes = if head.scale == Scale::Full { "full sizes" } else { "quick sizes (--full: as on a GPU)" };
    format!(
        "{}, {sizes}\n\n{}",
        head.adapter,
        columns("row", "verdict", ["measured", "at most", "margin", "samples", "s"])
    )
}

fn columns(name: &str, verdict: &str, [measured, most, margin, samples, seconds]: [&str; 5]) -> String {
    format!("{name:<18} {verdict:<11} {measured:>9} {most:>9} {margin:>8} {samples:>9} {seconds:>7}\n")
}

/// A row: its figures, and what they are of.
pub fn line(outcome: &Outcome) -> String {
    let (row, verdict) = (outcome.row, outcome.verdict());
    let dash = || "-".to_owned();
    let (value, samples) = match &outcome.measured {
        Ok(measured) => (figure(measured.value), figure(measured.samples as f64)),
        Err(_) => (dash(), dash()),
    };
    let margin = outcome.margin().map_or_else(dash, factor);
    let seconds = format!("{:.1}", outcome.seconds);
    let most = figure(row.most);
    let mut text = columns(row.name, word(&verdict), [&value, &most, &margin, &samples, &seconds]);
    text += &format!("    {}\n    {}{}\n", row.holds, row.quantity, found(outcome));
    if let Verdict::CannotTell(why) | Verdict::Fails(Some(why)) = verdict {
        text += &format!("    {why}\n");
    }
    text
}

/// What else there is to say of a figure, to go behind it.
fn found(outcome: &Outcome) -> String {
    let Ok(measured) = &outcome.measured else { return String::new() };
    let mut text = String::new();
    if !measured.note.is_empty() {
        text += &format!(" ({})", measured.note);
    }
    if let Some(bound) = bound(outcome.row, measured) {
        text += &format!("; below one in {} at 95 %", figure(1.0 / bound));
    }
    text
}

/// Of counts that are 0: the part of all samples that may still be wrong, with a confidence of 95 % (the rule of three).
fn bound(row: &Row, measured: &Measured) -> Option<f64> {
    (row.most == 0.0 && measured.value == 0.0 && measured.samples > 0).then(|| 3.0 / measured.samples as f64)
}

/// What comes behind all rows.
pub fn end(head: &Head, outcomes: &[Outcome]) -> String {
    let count = |is: fn(&Verdict) -> bool| outcomes.iter().filter(|outcome| is(&outcome.verdict())).count();
    let holds = count(|verdict| *verdict == Verdict::Holds);
    let fails = count(|verdict| matches!(verdict, Verdict::Fails(_)));
    let open = outcomes.len() - holds - fails;
    format!("\n{holds} hold, {fails} fail, {open} can't tell; {:.0} s\n", head.begin.elapsed().as_secs_f64())
}

pub fn json(head: &Head, outcomes: &[Outcome]) -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "adapter": head.adapter,
        "full": head.scale == Scale::Full,
        "seconds": head.begin.elapsed().as_secs_f64(),
        "holds": outcomes.iter().all(|outcome| outcome.verdict() == Verdict::Holds),
        "rows": outcomes.iter().map(row_json).collect::<Vec<_>>(),
    })
}

fn row_json(outcome: &Outcome) -> Value {
    let (row, verdict, measured) = (outcome.row, outcome.verdict(), outcome.measured.as_ref().ok());
    let why = match &verdict {
        Verdict::Holds | Verdict::Fails(None) => None,
        Verdict::Fails(Some(why)) | Verdict::CannotTell(why) => Some(why),
    };
    json!({
        "name": row.name,
        "holds": row.holds,
        "quantity": row.quantity,
        "at_most": row.most,
        "measured": measured.map(|measured| number(measured.value)),
        "samples": measured.map(|measured| measured.samples),
        "unit": row.unit,
        "note": measured.map(|measured| &measured.note),
        "below_at_95_percent": measured.and_then(|measured| bound(row, measured)),
        "margin": outcome.margin().map(number),
        "verdict": word(&verdict),
        "why": why,
        "seconds": outcome.seconds,
    })
}

/// A number that JSON has no word for, as text.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { json!(value.to_string()) }
}

/// A mistake and what saw it.
pub fn planted_line(planted: &Planted) -> String {
    let mut text = format!("{}: {}\n", planted.name, planted.wrong);
    match &planted.outcomes {
        Err(error) => text += &format!("    could not be planted: {error}\n"),
        Ok(outcomes) => {
            for outcome in outcomes {
                let seen = match outcome.verdict() {
                    _ if caught(outcome) => "seen by",
                    Verdict::CannotTell(_) => "can't be told by",
                    _ => "NOT seen by",
                };
                let why = match (&outcome.measured, outcome.verdict()) {
                    (_, Verdict::CannotTell(why)) => why,
                    (Ok(measured), _) => {
                        format!(
                            "{}: {}, at most {}",
                            outcome.row.quantity,
                            figure(measured.value),
                            figure(outcome.row.most)
                        )
                    }
                    (_, Verdict::Fails(Some(why))) => why,
                    _ => String::new(),
                };
                text += &format!("    {seen} {:<18} {why}\n", outcome.row.name);
            }
        }
    }
    text
}

pub fn planted_end(planted: &[Planted]) -> String {
    let seen = planted.iter().filter(|planted| planted.seen()).count();
    format!("\n{seen} of {} mistakes are seen\n", planted.len())
}

pub fn planted_json(head: &Head, planted: &[Planted]) -> Value {
    let entry = |planted: &Planted| {
        let rows = planted.outcomes.iter().flatten();
        let seen_by: Vec<&str> = rows.filter(|outcome| caught(outcome)).map(|outcome| outcome.row.name).collect();
        let rows: Vec<Value> = planted.outcomes.iter().flatten().map(row_json).collect();
        json!({ "name": planted.name, "wrong": planted.wrong, "seen_by": seen_by, "rows": rows })
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "adapter": head.adapter,
        "seconds": head.begin.elapsed().as_secs_f64(),
        "planted": planted.iter().map(entry).collect::<Vec<_>>(),
    })
}

fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Fails(_) => "FAILS",
        Verdict::CannotTell(_) => "can't tell",
    }
}

/// Three digits.
fn figure(value: f64) -> String {
    match value.abs() {
        size if size == 0.0 || (0.01..1e5).contains(&size) => {
            let digits = if size >= 100.0 || size.fract() == 0.0 { 0 } else { 2 };
            format!("{value:.digits$}")
        }
        _ => format!("{value:.1e}"),
    }
}

/// A factor, or that it is beyond all.
fn factor(value: f64) -> String {
    if value.is_finite() { format!("{}x", figure(value)) } else { "inf".to_owned() }
}
