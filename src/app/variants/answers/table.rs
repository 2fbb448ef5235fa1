//! A family as a flat file for programs, and as tables for users.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::numbers::{efficiency, exact, paths, setting, short, state};
use crate::app::shared::csv::field;
use crate::app::variants::record::{Against, Answer, Record, Snapshot};

/// A row a snapshot of every member; one for a member without any. Where there is no number, the field is empty. What is
/// measured against the reference is of the last snapshot.
pub fn csv(answer: &Answer) -> String {
    let paths = paths(answer);
    let mut text = String::from("member");
    for path in &paths {
        let _ = write!(text, ",{}", field(path));
    }
    text += ",spp,seconds,rays,error,efficiency,relmse,flip,mean_r,mean_g,mean_b,film_of,state,message\n";
    for record in &answer.records {
        let last = record.snapshots.len().saturating_sub(1);
        let snapshots: Vec<Option<&Snapshot>> = match record.snapshots.is_empty() {
            true => vec![None],
            false => record.snapshots.iter().map(Some).collect(),
        };
        for (i, snapshot) in snapshots.into_iter().enumerate() {
            let against = record.against.as_ref().filter(|_| i == last);
            text += &csv_row(record, &paths, snapshot, against);
        }
    }
    text
}

fn csv_row(record: &Record, paths: &[&str], snapshot: Option<&Snapshot>, against: Option<&Against>) -> String {
    let (word, message) = state(record);
    let mut fields = vec![field(&record.name)];
    fields.extend(paths.iter().map(|path| field(setting(record, path).unwrap_or_default())));
    fields.push(snapshot.map(|s| s.spp.to_string()).unwrap_or_default());
    fields.push(exact(snapshot.map(|s| s.seconds)));
    fields.push(snapshot.map(|s| s.rays.to_string()).unwrap_or_default());
    fields.push(exact(snapshot.map(|s| s.relmse)));
    fields.push(exact(snapshot.and_then(efficiency)));
    fields.push(exact(against.map(|a| a.relmse)));
    fields.push(exact(against.and_then(|a| a.flip)));
    fields.extend((0..3).map(|channel| exact(against.map(|a| a.mean[channel]))));
    fields.push(field(record.film_of.as_deref().unwrap_or_default()));
    fields.push(word.to_owned());
    fields.push(field(&message));
    fields.join(",") + "\n"
}

/// Each member at its last snapshot, all snapshots where there are several, and what there is to say of single members.
pub fn markdown(answer: &Answer) -> String {
    let mut text = format!("# {}\n\n{}\n\n", cell(&answer.name), head(answer));
    let paths = paths(answer);
    text += "| member |";
    for path in &paths {
        let _ = write!(text, " {} |", cell(path));
    }
    text += " spp | seconds | Mrays | error | efficiency |";
    text += if answer.reference.is_some() { " relMSE | FLIP | mean R, G, B |\n" } else { "\n" };
    let numbers = if answer.reference.is_some() { 8 } else { 5 };
    let _ = writeln!(text, "|---|{}{}", "---|".repeat(paths.len()), "--:|".repeat(numbers));
    for record in &answer.records {
        let settings: String =
            paths.iter().map(|path| format!(" {} |", cell(setting(record, path).unwrap_or("")))).collect();
        let against = if answer.reference.is_some() { against(record) } else { String::new() };
        let snapshot = record.snapshots.last();
        let _ = writeln!(text, "| {} |{settings} {}{against}", cell(&record.name), measured(record, snapshot));
    }
    text + &snapshots(answer) + &notes(answer)
}

/// What the numbers mean, and what they are of.
pub fn head(answer: &Answer) -> String {
    let adapters: BTreeSet<&str> =
        answer.records.iter().map(|record| record.adapter.as_str()).filter(|name| !name.is_empty()).collect();
    let mut text = format!("Of `{}`", answer.file);
    if !adapters.is_empty() {
        let _ = write!(text, "; {}", adapters.into_iter().collect::<Vec<_>>().join(", "));
    }
    text += ".";
    if answer.interrupted {
        text += " Ended early: not all was rendered.";
    }
    text += " Seconds are of tracing; error is each film's own estimate of its relMSE, and efficiency is 1 / (error x seconds).";
    if let Some(reference) = &answer.reference {
        let _ = write!(
            text,
            " relMSE, FLIP and mean are against `{reference}`: the mean is the member's as part of the reference's."
        );
    }
    for remark in &answer.remarks {
        let _ = write!(text, " {remark}");
    }
    text
}

fn measured(record: &Record, snapshot: Option<&Snapshot>) -> String {
    let Some(s) = snapshot else {
        let (word, _) = state(record);
        return format!("{word} | | | | |");
    };
    format!(
        "{} | {} | {} | {} | {} |",
        s.spp,
        short(s.seconds),
        short(s.rays as f64 * 1e-6),
        short(s.relmse),
        efficiency(s).map_or("-".to_owned(), short)
    )
}

fn against(record: &Record) -> String {
    let Some(a) = &record.against else { return " | | |".to_owned() };
    let flip = a.flip.map_or("-".to_owned(), short);
    let mean = a.mean.map(|part| format!("{part:.4}")).join(", ");
    format!(" {} | {flip} | {mean} |", short(a.relmse))
}

fn snapshots(answer: &Answer) -> String {
    if answer.records.iter().all(|record| record.snapshots.len() < 2) {
        return String::new();
    }
    let mut text = String::from(
        "\n## By samples\n\n| member | spp | seconds | Mrays | error | efficiency |\n|---|--:|--:|--:|--:|--:|\n",
    );
    for record in &answer.records {
        for snapshot in &record.snapshots {
            let _ = writeln!(text, "| {} | {}", cell(&record.name), measured(record, Some(snapshot)));
        }
    }
    text
}

/// What is to be said of single members: films that are shared, samples that were bad, failures.
fn notes(answer: &Answer) -> String {
    let mut text = String::new();
    for record in &answer.records {
        let (_, message) = state(record);
        let name = &record.name;
        if !message.is_empty() {
            let _ = writeln!(text, "- `{name}`: {}", message.replace('\n', " "));
        }
        if let Some(other) = &record.film_of {
            let _ = writeln!(text, "- `{name}` is the film of `{other}`: seconds and rays are of that film.");
        }
        if record.bad_samples > 0 {
            let _ = writeln!(text, "- `{name}`: {} samples were no numbers, and are left out.", record.bad_samples);
        }
    }
    if text.is_empty() { text } else { format!("\n## Notes\n\n{text}") }
}

/// Text that stays within a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('\\', "\\\\").replace('|', "\\|").replace(['\n', '\r'], " ")
}
