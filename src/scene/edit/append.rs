//! A new entry behind the last of a block, as one would write it by hand: on a line of its own where the others are, else in the line.

use super::trivia::{Piece, pieces};
use super::value::{Value, offset, span};
use crate::scene::ron::{Kind, Node};

/// Spaces of a level where a file shows no other.
const UNIT: &str = "    ";

/// The whole text with an entry more in `block`, which has fields or is empty; none where the block can't have a key of this name. `root` is the
/// block of the whole file.
pub fn append(root: &Node, block: &Node, name: &str, value: &Value) -> Option<String> {
    let text = block.text.text.as_str();
    let key = key(block, name)?;
    let Kind::Fields(fields) = &block.kind else { return Some(fill(root, block, &key, value)) };
    let Some((_, _, last)) = fields.last() else { return Some(fill(root, block, &key, value)) };
    let (end, close) = (span(last).end, span(block).end - 1);
    let gap = &text[end..close];
    let comma = comma(gap).map(|at| end + at + 1);
    let mut out = String::with_capacity(text.len() + 80);
    if gap.contains('\n') {
        let indent = indent_of_entries(root, block, fields.iter().map(|(_, place, _)| offset(block, place)));
        let entry = entry(&key, value, Some(&Lines::of(root, &indent)));
        let line_end = comma.unwrap_or(end) + rest_of_line(&text[comma.unwrap_or(end)..close]);
        out += &text[..end];
        out += if comma.is_none() { "," } else { "" };
        out += &text[end..line_end];
        out += &format!("{}{indent}{entry},", new_line(text));
        out += &text[line_end..];
    } else {
        let entry = entry(&key, value, None);
        let at = comma.unwrap_or(end);
        out += &text[..at];
        out += &if comma.is_some() { format!(" {entry},") } else { format!(", {entry}") };
        out += &text[at..];
    }
    Some(out)
}

/// The whole text with an entry in a block that has none.
fn fill(root: &Node, block: &Node, key: &str, value: &Value) -> String {
    let text = block.text.text.as_str();
    let (open, close) = (span(block).start + 1, span(block).end - 1);
    let gap = &text[open..close];
    let Some(line) = gap.rfind('\n').map(|at| open + at + 1) else {
        let entry = entry(key, value, None);
        let entry = match (&text[open - 1..open], gap.trim().is_empty()) {
            ("{", true) => return format!("{} {entry} {}", &text[..open], &text[close..]),
            (_, true) => entry,
            ("{", false) => format!(" {entry}"),
            (_, false) => entry,
        };
        return format!("{}{entry}{}", &text[..open], &text[open..]);
    };
    let outer = leading(text, close);
    let indent = format!("{outer}{}", unit(root));
    let entry = entry(key, value, Some(&Lines::of(root, &indent)));
    // Below the comments, unless one of them ends in the line of the bracket.
    match text[line..close].trim().is_empty() {
        true => format!("{}{indent}{entry},{}{}", &text[..line], new_line(text), &text[line..]),
        false => format!("{}{}{indent}{entry},{}", &text[..open], new_line(text), &text[open..]),
    }
}

/// How an entry that has lines of its own is set.
struct Lines<'t> {
    new_line: &'static str,
    indent: &'t str,
    unit: String,
}

impl<'t> Lines<'t> {
    fn of(root: &Node, indent: &'t str) -> Self {
        Self { new_line: new_line(&root.text.text), indent, unit: unit(root) }
    }
}

/// `key: value`; of a map, each entry in a line of its own, where there are lines.
fn entry(key: &str, value: &Value, lines: Option<&Lines>) -> String {
    let (Value::Map(entries), Some(Lines { new_line, indent, unit })) = (value, lines) else {
        return format!("{key}: {}", value.text());
    };
    let entries: String =
        entries.iter().map(|(name, value)| format!("{new_line}{indent}{unit}{name:?}: {},", value.text())).collect();
    format!("{key}: {{{entries}{new_line}{indent}}}")
}

/// A name as the key of a block: in quotes in `{ .. }`; in `( .. )` a name that needs none.
fn key(block: &Node, name: &str) -> Option<String> {
    if block.source.starts_with('{') {
        return Some(format!("{name:?}"));
    }
    let is_plain = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    is_plain.then(|| name.to_owned())
}

/// Where the comma is that stands before anything else but comments.
fn comma(gap: &str) -> Option<usize> {
    let mut at = 0;
    for piece in pieces(gap) {
        if piece == Piece::Comma {
            return Some(at);
        }
        at += piece.len();
    }
    None
}

/// The bytes up to the end of the line, over comments that end in it.
fn rest_of_line(gap: &str) -> usize {
    let mut at = 0;
    for piece in pieces(gap) {
        match piece {
            Piece::Space(space) if space.contains('\n') => {
                let line = space.split('\n').next().unwrap_or_default();
                return at + line.trim_end_matches('\r').len();
            }
            Piece::Comment(comment) if comment.contains('\n') => return at,
            _ => at += piece.len(),
        }
    }
    // All in the line of the bracket: directly behind what is there.
    0
}

/// What stands before the entries that begin a line; else a level more than the line of the block itself. `places` are those of the keys.
fn indent_of_entries(root: &Node, block: &Node, places: impl DoubleEndedIterator<Item = usize>) -> String {
    let text = block.text.text.as_str();
    let open = span(block).start;
    let first_in_line = |place: &usize| {
        text[open..*place].contains('\n')
            && text[line_start(text, *place)..*place].trim_matches(['"', ' ', '\t']).is_empty()
    };
    match places.rev().find(first_in_line) {
        Some(place) => leading(text, place).to_owned(),
        None => format!("{}{}", leading(text, open), unit(root)),
    }
}

/// A level of the file: what its first fields begin with.
fn unit(root: &Node) -> String {
    let Kind::Fields(fields) = &root.kind else { return UNIT.to_owned() };
    let text = root.text.text.as_str();
    let open = span(root).start;
    let own_line = |place: usize| text[open..place].contains('\n').then(|| leading(text, place));
    let shown = fields.iter().find_map(|(_, place, _)| own_line(offset(root, place)));
    shown.filter(|shown| !shown.is_empty()).unwrap_or(UNIT).to_owned()
}

/// White space at the start of the line of a place.
fn leading(text: &str, place: usize) -> &str {
    let line = &text[line_start(text, place)..];
    &line[..line.find(|c| c != ' ' && c != '\t').unwrap_or(line.len())]
}

fn line_start(text: &str, place: usize) -> usize {
    text[..place].rfind('\n').map_or(0, |at| at + 1)
}

/// How the lines of a text end.
fn new_line(text: &str) -> &'static str {
    let end = text.find('\n').unwrap_or(0);
    if text[..end].ends_with('\r') { "\r\n" } else { "\n" }
}
