//! The page: one file with all pictures in it, which asks nothing of any network.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::blocks::blocks;
use super::canvas::Canvas;
use super::numbers::{efficiency, paths, setting, state};
use super::thumb::{Thumb, picture_of};
use super::{sheet, table};
use crate::app::shared::plot::{self, Axis, Line};
use crate::app::variants::record::{Answer, Record, State};

/// Bytes of pictures that a page may hold; with more of them it holds small ones.
pub const MOST_BYTES: u64 = 40_000_000;

/// Lines of the plot that can be told apart.
const MOST_LINES: usize = 12;

const HTML: &str = include_str!("page.html");
const CSS: &str = include_str!("page.css");

/// The scripts, in the order in which they are run.
const SCRIPTS: [&str; 4] =
    [include_str!("page.js"), include_str!("sheet.js"), include_str!("viewer.js"), include_str!("table.js")];

/// The page of an answer whose pictures are in the folder's `members`.
pub fn html(answer: &Answer, folder: &Path) -> String {
    html_within(answer, folder, MOST_BYTES)
}

/// The same, with small pictures where those that there are take more than `most` bytes.
pub fn html_within(answer: &Answer, folder: &Path, most: u64) -> String {
    let length = |record: &Record| std::fs::metadata(picture_of(folder, &record.name)).map_or(0, |file| file.len());
    let small = answer.records.iter().map(length).sum::<u64>() > most;
    // Small enough that all of them together are as much as a page may hold, three bytes a pixel.
    let side = (most / 3 / answer.records.len().max(1) as u64).isqrt().clamp(24, u64::from(sheet::SIDE)) as u32;
    let side = small.then_some(side);
    let paths = paths(answer);
    let members: Vec<Value> = answer.records.iter().map(|record| member(&paths, record, folder, side)).collect();
    let data = json!({
        "name": answer.name,
        "reference": answer.reference,
        "small": small,
        "paths": paths,
        "blocks": blocks(answer).iter().map(|block| json!({
            "title": block.title,
            "rowAxis": block.row_axis,
            "columnAxis": block.column_axis,
            "rows": block.rows,
            "columns": block.columns,
            "extent": block.extent(),
            "cells": block.cells.iter().map(|cell| json!({
                "row": cell.row, "column": cell.column, "member": cell.member, "caption": cell.caption,
            })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "members": members,
    });
    // No text of a member may end the script that holds it.
    let data = data.to_string().replace('<', "\\u003c");
    let plot = error_against_seconds(answer).unwrap_or_default();
    let plot = if plot.is_empty() { plot } else { format!("<section><h2>Error against seconds</h2>{plot}</section>") };
    let scripts = SCRIPTS.join("\n");
    // One pass: what is put in may look like a place itself.
    let put = [
        ("title", escaped(&answer.name)),
        ("about", escaped(&table::head(answer).replace('`', ""))),
        ("style", CSS.to_owned()),
        ("plot", plot),
        ("data", data),
        ("script", scripts),
    ];
    let mut parts = HTML.split("{{");
    let mut page = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once("}}").unwrap_or((part, ""));
        let content = put.iter().find(|(own, _)| *own == name).map_or("", |(_, content)| content);
        page += content;
        page += rest;
    }
    page
}

fn member(paths: &[&str], record: &Record, folder: &Path, small: Option<u32>) -> Value {
    let (word, note) = state(record);
    let last = record.snapshots.last();
    let (picture, note) = match record.state {
        State::Done | State::Lost { .. } => match picture(record, folder, small) {
            Ok(picture) => (Some(picture), note),
            Err(why) => (None, why),
        },
        State::Failed { .. } | State::Missing => (None, note),
    };
    json!({
        "name": record.name,
        "state": word,
        "note": note,
        "picture": picture,
        "settings": paths.iter().map(|path| setting(record, path)).collect::<Vec<_>>(),
        "spp": last.map(|s| s.spp),
        "seconds": last.map(|s| s.seconds),
        "rays": last.map(|s| s.rays),
        "error": last.map(|s| s.relmse),
        "efficiency": last.and_then(efficiency),
        "relmse": record.against.map(|a| a.relmse),
        "flip": record.against.and_then(|a| a.flip),
        "mean": record.against.map(|a| a.mean),
        "filmOf": record.film_of,
        "bad": record.bad_samples,
        "adapter": record.adapter,
        "repeat": record.repeat,
    })
}

/// A member's picture as a part of the page; a small one of that many pixels at most a side.
fn picture(record: &Record, folder: &Path, small: Option<u32>) -> Result<String, String> {
    let path = picture_of(folder, &record.name);
    let whole = || std::fs::read(&path).map_err(|error| format!("{}: can't read: {error}", path.display()));
    let content = small.map_or_else(whole, |side| reduced(&path, side))?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(content)))
}

fn reduced(path: &Path, side: u32) -> Result<Vec<u8>, String> {
    let thumb = Thumb::read(path, side).map_err(|error| error.to_string())?;
    let canvas = Canvas { size: thumb.size, pixels: thumb.pixels };
    canvas.png().map_err(|error| format!("{}: {error}", path.display()))
}

/// The plot; none where no member was looked at twice. Of very many members, those of the greatest efficiency.
fn error_against_seconds(answer: &Answer) -> Option<String> {
    answer.records.iter().find(|record| record.snapshots.len() > 1)?;
    let line = |record: &Record| {
        let points = record.snapshots.iter().map(|s| (s.seconds, s.relmse, s.relmse, s.relmse)).collect();
        Line { name: record.name.clone(), points }
    };
    let films = answer.records.iter().filter(|record| record.film_of.is_none() && !record.snapshots.is_empty());
    let mut films: Vec<&Record> = films.collect();
    let mut about = "each film's own estimate of its error".to_owned();
    if films.len() > MOST_LINES {
        about += &format!("; of {} members the {MOST_LINES} of the greatest efficiency", films.len());
        let last = |record: &Record| record.snapshots.last().and_then(efficiency).unwrap_or(0.0);
        films.sort_by(|a, b| last(b).total_cmp(&last(a)));
        films.truncate(MOST_LINES);
    }
    plot::svg(&answer.name, &about, films.into_iter().map(line).collect(), Axis::Seconds)
}

/// Text as HTML takes it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
