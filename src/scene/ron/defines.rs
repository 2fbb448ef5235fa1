//! Changes of single values: `materials.teapot.ns=64` changes one of the tree before it is typed.

use std::path::Path;

use super::tree::{Kind, MAX_DEPTH, Node, parse_slice};
use crate::scene::define::{Define, Written};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::text::Text;

/// The texts `path=value` that a scene's defines are read from, and reported where they are written.
pub fn define_texts(defines: &[Define]) -> Vec<Text> {
    let text = |define: &Define| match &define.written {
        Written::CommandLine => Text::new(Path::new("-D"), format!("{}={}", define.path, define.value)),
        Written::File { path, value } => Text::change(&define.path, &define.value, path, value),
    };
    defines.iter().map(text).collect()
}

/// Changes `root` as each define says, in order.
///
/// `texts` are those of [`define_texts`] for the same `defines`. A value may be any RON, and a bare word where a string is meant.
/// `plain` says which field a plain value at a path stands for, if any: it becomes that when another field is set beside it.
pub fn apply_defines<'a>(
    root: &mut Node<'a>,
    defines: &[Define],
    texts: &'a [Text],
    plain: PlainField,
) -> Result<(), Diagnostic> {
    for (define, text) in defines.iter().zip(texts) {
        let (path, value) = text.text.split_at(define.path.len());
        let about = |path, error| about(define, path, error);
        let value = parse_slice(text, &value[1..]).map_err(|error| about(path, unquoted(&value[1..], error)))?;
        let segments = segments(text, path)?;
        set(root, &Change { text, path: &segments, plain }, 0, value).map_err(|error| about(path, error))?;
    }
    Ok(())
}

/// Says which define an error is about.
fn about(define: &Define, path: &str, error: Diagnostic) -> Diagnostic {
    let what = match define.written {
        Written::CommandLine => "in the define",
        Written::File { .. } => "in the change of",
    };
    Diagnostic { message: format!("{what} `{path}`: {}", error.message), ..error }
}

/// Adds how a text is written, where a value may be one without its quotes, which a shell takes away.
fn unquoted(value: &str, error: Diagnostic) -> Diagnostic {
    let is_text = value.contains(char::is_alphabetic)
        && value.chars().all(|letter| letter.is_alphanumeric() || " ._-/\\:".contains(letter));
    match is_text {
        true => {
            error.help(format!("a text stands in double quotes; for a shell, with single ones around: '\"{value}\"'"))
        }
        false => error,
    }
}

/// The parts of a path, at its dots; a part in double quotes may hold dots itself, and one in brackets is a number: `models[0].path`.
fn segments<'a>(text: &'a Text, path: &'a str) -> Result<Vec<&'a str>, Diagnostic> {
    let mut list = Vec::new();
    let mut rest = path;
    loop {
        let (segment, after) = match rest.strip_prefix('"').and_then(|quoted| quoted.split_once('"')) {
            Some((segment, after)) => (segment, after),
            None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
        };
        if segment.is_empty() {
            let message = format!("`{path}` is no field path");
            return Err(text.error(rest, message).help("write it like materials.teapot.ns=64"));
        }
        list.push(segment);
        let mut after = after;
        while let Some((number, next)) = after.strip_prefix('[').and_then(|open| open.split_once(']')) {
            if number.is_empty() || !number.bytes().all(|byte| byte.is_ascii_digit()) {
                return Err(text
                    .error(&after[1..], "expected a number in brackets")
                    .help("write it like models[0].path"));
            }
            list.push(number);
            after = next;
        }
        if list.len() > MAX_DEPTH {
            return Err(text.error(segment, format!("a field path more than {MAX_DEPTH} levels deep")));
        }
        match after.strip_prefix('.') {
            Some(next) => rest = next,
            None if after.is_empty() => return Ok(list),
            None => return Err(text.error(after, "expected `.`, a number in brackets, or the end of the path here")),
        }
    }
}

/// The field that a plain value at a path stands for.
type PlainField = fn(&[&str]) -> Option<&'static str>;

/// A define that is being applied.
struct Change<'d, 'a> {
    text: &'a Text,
    path: &'d [&'a str],
    plain: PlainField,
}

/// Puts `value` at the path's parts from `depth` on, below `node`; fields that are not there are added, items must be.
fn set<'a>(node: &mut Node<'a>, change: &Change<'_, 'a>, depth: usize, value: Node<'a>) -> Result<(), Diagnostic> {
    let Change { text, path, plain } = *change;
    let Some(segment) = path.get(depth).copied() else {
        *node = value;
        return Ok(());
    };
    if let Kind::Variant(_, Some(content)) = &mut node.kind {
        return set(content, change, depth, value);
    }
    if matches!(&node.kind, Kind::Items(items) if items.is_empty()) {
        node.kind = Kind::Fields(Vec::new());
    }
    if let (Kind::Scalar, Some(field)) = (&node.kind, plain(&path[..depth])) {
        node.kind = Kind::Fields(vec![(field.to_owned(), node.source, node.clone())]);
    }
    match &mut node.kind {
        Kind::Fields(fields) => {
            let at = fields.iter().position(|(name, ..)| name == segment).unwrap_or_else(|| {
                let empty = Node { text, source: segment, kind: Kind::Fields(Vec::new()) };
                fields.push((segment.to_owned(), segment, empty));
                fields.len() - 1
            });
            set(&mut fields[at].2, change, depth + 1, value)
        }
        Kind::Items(items) => {
            let count = items.len();
            match segment.parse::<usize>().ok().and_then(|at| items.get_mut(at)) {
                Some(item) => set(item, change, depth + 1, value),
                None => Err(text.error(segment, format!("`{segment}` is none of the items 0 to {}", count - 1))),
            }
        }
        _ => Err(text.error(segment, format!("there is no field `{segment}` in {}", node.describe()))),
    }
}
