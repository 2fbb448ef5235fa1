//! What a path of a sweep goes through: a list, even steps, steps of one factor, or named values.

use super::family::MOST_MEMBERS;
use super::label::{cut, label_of, labels_of, rounded};
use std::collections::BTreeMap;

use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::ron::{Kind, Node};

/// The most values of a path: there are no more members.
const MOST: u32 = MOST_MEMBERS as u32;

/// Numbers of a range reach so far.
const FARTHEST: f64 = 1e30;

/// Digits of the numbers between its ends: 0.15, not 0.15000000000000002.
const DIGITS: usize = 7;

/// A value that a path gets.
#[derive(Clone, Debug)]
pub struct SweptValue {
    /// Fit for a part of a file's name.
    pub label: String,
    /// As it would be written in a scene file.
    pub value: String,
    /// Where it is written: a warning without its message.
    pub place: Diagnostic,
}

/// The values of a path, at least one.
pub fn values_of(node: &Node) -> Result<Vec<SweptValue>, Diagnostic> {
    let error = |node: &Node, message: String| node.text.error(node.source, message);
    let values = match &node.kind {
        Kind::Items(items) if node.source.starts_with('[') => items.iter().map(one).collect(),
        Kind::Variant("range", Some(content)) => steps(node, content, false)?,
        Kind::Variant("log", Some(content)) => steps(node, content, true)?,
        Kind::Variant("named", Some(content)) => {
            let fields = content.inner().fields().map_err(|message| {
                error(content, format!("named: {message}")).help("write named({\"name\": value, ..})")
            })?;
            let named =
                |(name, _, value): &(String, &str, Node)| SweptValue { label: cut(label_of(name)), ..one(value) };
            fields.iter().map(named).collect()
        }
        _ => {
            let message = format!("expected what to go through, found {}", node.describe());
            return Err(error(node, message).help(
                "write a list [a, b], range(from, to, count), log(from, to, count), or named({\"name\": value, ..})",
            ));
        }
    };
    if values.is_empty() {
        return Err(error(node, "there is nothing to go through".into()).help("give one value at least"));
    }
    Ok(values)
}

/// A value that is written as it is.
fn one(node: &Node) -> SweptValue {
    let text = node.string().unwrap_or_else(|_| node.source.to_owned());
    SweptValue { label: cut(label_of(&text)), value: node.source.to_owned(), place: place_of(node) }
}

/// `count` numbers from one to another: evenly, or each by the same factor.
fn steps(node: &Node, content: &Node, by_factor: bool) -> Result<Vec<SweptValue>, Diagnostic> {
    let word = if by_factor { "log" } else { "range" };
    let about = |node: &Node, message: String| node.text.error(node.source, format!("{word}: {message}"));
    let parts = content.items().ok().filter(|items| items.len() == 3);
    let help = format!("write {word}(from, to, count), such as {word}(0.1, 0.9, 5)");
    let parts = parts.ok_or_else(|| {
        about(node, format!("expected three numbers, found {}", content.describe())).help(help.clone())
    })?;
    let number =
        |node: &Node| node.number(-FARTHEST, FARTHEST).map_err(|message| about(node, message).help(help.clone()));
    let (from, to) = (number(&parts[0])?, number(&parts[1])?);
    let count = parts[2]
        .integer(1, MOST)
        .map_err(|message| about(&parts[2], format!("how many: {message}")).help(help.clone()))?;
    if by_factor && (from <= 0.0 || to <= 0.0) {
        let wrong = if from <= 0.0 { &parts[0] } else { &parts[1] };
        return Err(about(wrong, "both ends must be above 0".into()).help("range(from, to, count) goes through 0 too"));
    }
    let at = |i: u32| {
        let part = if count > 1 { f64::from(i) / f64::from(count - 1) } else { 0.0 };
        match i {
            0 => from,
            _ if i == count - 1 => to,
            _ if by_factor => rounded(from * (to / from).powf(part), DIGITS),
            _ => rounded(from + (to - from) * part, DIGITS),
        }
    };
    let values: Vec<f64> = (0..count).map(at).collect();
    let labels = labels_of(&values).into_iter();
    let swept = |(label, value): (String, &f64)| SweptValue { label, value: value.to_string(), place: place_of(node) };
    Ok(labels.zip(&values).map(swept).collect())
}

/// Two values of one label would be two members of one name.
pub fn refuse_equal(values: &[SweptValue]) -> Result<(), Diagnostic> {
    let mut known: BTreeMap<String, &SweptValue> = BTreeMap::new();
    for value in values {
        if let Some(first) = known.insert(value.label.to_lowercase(), value) {
            let place = if first.place.line > 0 { format!(", as in line {}", first.place.line) } else { String::new() };
            let message = format!("a second value named `{}`{place}", value.label);
            return Err(Diagnostic { severity: Severity::Error, message, ..value.place.clone() }
                .help("leave one out, or name them: named({\"a\": .., \"b\": ..})"));
        }
    }
    Ok(())
}

/// Where a value is written: a warning without its message.
pub fn place_of(node: &Node) -> Diagnostic {
    node.text.at(Severity::Warning, node.source, "")
}
