//! Edits as text and as JSON.

use std::path::Path;

use serde_json::{Value, json};

use super::edit::{Edit, Lint, State, age, now};
use super::folder::Kept;
use crate::app::shared::describe::quoted;
use crate::scene::printable;

/// All of them, the newest first.
pub fn all(edits: &[Kept], folder: &Path, as_json: bool) -> String {
    if as_json {
        let list: Vec<Value> = edits.iter().rev().map(value).collect();
        return format!("{}\n", Value::Array(list));
    }
    if edits.is_empty() {
        let place = folder.display();
        return format!("no edits in {place}: a window (lucerna view) keeps there what is saved while it is open\n");
    }
    let heads = ["edit", "saved", "scene", "what", "pixels", "lint", "vs", "verdict"].map(str::to_owned);
    let rows: Vec<[String; 8]> = std::iter::once(heads).chain(edits.iter().rev().map(row)).collect();
    let widths: [usize; 8] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default());
    let line = |row: &[String; 8]| {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    rows.iter().map(|row| printable(&line(row))).collect()
}

/// One of them, and what can be done with it.
pub fn one(kept: &Kept, written: Option<&Path>, as_json: bool) -> String {
    if as_json {
        return format!("{}\n", value(kept));
    }
    let Kept { number, before, edit, .. } = kept;
    let mut text = format!("edit {number}: {}, {}, {}\n", edit.what(), edit.scene, age(edit.saved, now()));
    edit.files.iter().for_each(|file| text += &format!("  {file}\n"));
    let lint = match &edit.lint {
        Lint::Warned(warnings) => warnings.join("\n"),
        Lint::Clean => "nothing found".to_owned(),
        Lint::NotLinted => String::new(),
    };
    let facts = [edit.pixels_told(), lint, verdict(edit, &edit.verdict.line)];
    let names = ["pixels after the save", "lint", "verdict"];
    for (name, fact) in names.into_iter().zip(facts).filter(|(_, fact)| !fact.is_empty()) {
        text += &format!("  {name}: {}\n", fact.trim_end().replace('\n', "\n    "));
    }
    let scene = quoted(&edit.scene);
    match (written, before) {
        (Some(folder), Some(before)) => {
            let new = quoted(&folder.display().to_string());
            let old = quoted(&format!("{}-before", folder.display()));
            text +=
                &format!("  written to {}\n  to judge it: lucerna edits {before} --output {old}\n", folder.display());
            text += &format!("               lucerna judge {scene} --old {old} --new {new}\n");
        }
        (Some(folder), None) => text += &format!("  written to {}\n", folder.display()),
        (None, Some(before)) => {
            text +=
                &format!("  ran before: edit {before}\n  to have its shaders: lucerna edits {number} --output DIR\n");
        }
        (None, None) if kept.shaders.is_some() => {
            text += &format!("  to have its shaders: lucerna edits {number} --output DIR\n");
        }
        (None, None) => {}
    }
    printable(&text)
}

fn row(kept: &Kept) -> [String; 8] {
    let edit = &kept.edit;
    let lint = match &edit.lint {
        Lint::Clean => "nothing found".to_owned(),
        Lint::Warned(warnings) if warnings.len() == 1 => "1 warning".to_owned(),
        Lint::Warned(warnings) => format!("{} warnings", warnings.len()),
        Lint::NotLinted => String::new(),
    };
    [
        kept.number.to_string(),
        age(edit.saved, now()),
        edit.scene.clone(),
        edit.what(),
        edit.pixels_told(),
        lint,
        kept.before.map_or(String::new(), |before| before.to_string()),
        verdict(edit, &edit.verdict.short),
    ]
}

/// What was known when it was last written: a window may be judging it still, or have been closed before it did.
fn verdict(edit: &Edit, words: &str) -> String {
    match edit.verdict.state {
        State::Waiting | State::Judging => "not judged yet".to_owned(),
        _ => words.to_owned(),
    }
}

fn value(kept: &Kept) -> Value {
    let Kept { number, window, before, shaders, edit } = kept;
    json!({
        "number": number,
        "window": window,
        "before": before,
        "kind": edit.kind,
        "scene": edit.scene,
        "files": edit.files,
        "saved": edit.saved,
        "pixels": edit.pixels,
        "lint": edit.lint,
        "verdict": edit.verdict,
        "has_shaders": shaders.is_some(),
    })
}
