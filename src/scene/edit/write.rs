//! One value of a scene file's text, put where its path leads: exchanged where it is written, else added to its block.

use super::append::append;
use super::path::Step;
use super::value::{Value, span};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::file::{plain_field, scene_fields};
use crate::scene::ron::{Kind, Node, parse};
use crate::scene::text::Text;

/// What became of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// It is there already.
    Same,
    /// The whole text with another value.
    Changed(String),
    /// The whole text with a value more.
    Added(String),
}

/// Puts a value at a path. The rest of the text stays as it is, to the byte.
pub fn write(text: &Text, path: &[Step], value: &Value) -> Result<Written, Diagnostic> {
    let root = scene_fields(parse(text)?);
    let written = put(&root, path, value)?;
    let new = match &written {
        Written::Same => return Ok(written),
        Written::Changed(new) | Written::Added(new) => Text::new(&text.file, new.clone()),
    };
    // Whatever a layout may be: a text that does not say the value is not written.
    let says = parse(&new).is_ok_and(|root| follow(&scene_fields(root), path).is_some_and(|node| value.is(&node)));
    match says {
        true => Ok(written),
        false => Err(text
            .error(root.source, format!("`{}` can't be written into this layout", Step::shown(path)))
            .help("write it by hand: in the window, C and the buttons `copy as RON` give lines for the file")),
    }
}

/// The node at a path, if there is one.
pub fn follow<'a>(root: &Node<'a>, path: &[Step]) -> Option<Node<'a>> {
    path.iter().try_fold(root.clone(), |node, step| match (step, node.kind) {
        (Step::Field(name), Kind::Fields(fields)) => {
            fields.into_iter().find(|(field, ..)| field == name).map(|(.., node)| node)
        }
        (Step::Key(name), Kind::Fields(fields)) => {
            fields.into_iter().find(|(field, ..)| field == name).map(|(.., node)| node)
        }
        (Step::Item(at), Kind::Items(items)) => items.into_iter().nth(*at),
        (Step::Variant(name), Kind::Variant(written, content)) if written == *name => content.map(|content| *content),
        _ => None,
    })
}

fn put(root: &Node, path: &[Step], value: &Value) -> Result<Written, Diagnostic> {
    let mut node = root;
    for (done, step) in path.iter().enumerate() {
        let refuse = |message: String| Err(node.text.error(node.source, message));
        let name = match (step, &node.kind) {
            (Step::Field(name), _) => *name,
            (Step::Key(name), _) => name.as_str(),
            (Step::Variant(name), Kind::Variant(written, Some(content))) if written == name => {
                node = content;
                continue;
            }
            (Step::Item(at), Kind::Items(items)) if *at < items.len() => {
                node = &items[*at];
                continue;
            }
            _ => return refuse(format!("`{}` is something else here", Step::shown(&path[..=done]))),
        };
        let rest = &path[done + 1..];
        match &node.kind {
            Kind::Fields(fields) => match fields.iter().find(|(field, ..)| field == name) {
                Some((.., found)) => node = found,
                None => return add(root, node, name, &nested(rest, value), path),
            },
            Kind::Items(items) if items.is_empty() => return add(root, node, name, &nested(rest, value), path),
            Kind::Scalar => {
                let names = Step::names(&path[..done]);
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let Some(plain) = plain_field(&names) else {
                    return refuse(format!("`{}` is one value here, and has no fields", Step::shown(&path[..done])));
                };
                let text = format!("({plain}: {}, {name}: {})", node.source, nested(rest, value).text());
                return Ok(Written::Added(exchanged(root, vec![(span(node), text)])));
            }
            Kind::Variant("None", None) => {
                let message =
                    format!("`{}` is taken away here: nothing of it can be changed", Step::shown(&path[..done]));
                return Err(node
                    .text
                    .error(node.source, message)
                    .help("write `()` in place of `None`, and save again"));
            }
            _ => return refuse(format!("`{}` has no fields here", Step::shown(&path[..done]))),
        }
    }
    let mut changes = Vec::new();
    value.compare(node, &mut changes);
    match changes.is_empty() {
        true => Ok(Written::Same),
        false => Ok(Written::Changed(exchanged(root, changes))),
    }
}

fn add(root: &Node, block: &Node, name: &str, value: &Value, path: &[Step]) -> Result<Written, Diagnostic> {
    match append(root, block, name, value) {
        Some(text) => Ok(Written::Added(text)),
        None => Err(block
            .text
            .error(block.source, format!("`{}` can't be a name in a block in ( )", Step::shown(path)))
            .help("write the block in { }, its names in double quotes")),
    }
}

/// A value within the blocks that a path goes through.
fn nested(path: &[Step], value: &Value) -> Value {
    path.iter().rev().fold(value.clone(), |inner, step| match step {
        Step::Field(name) => Value::Struct(vec![((*name).to_owned(), inner)]),
        Step::Key(name) => Value::Map(vec![(name.clone(), inner)]),
        Step::Variant(name) => Value::variant(name, inner),
        // A list is never made: its items are what is there.
        Step::Item(_) => inner,
    })
}

/// The text of a tree with some of its parts, which do not overlap and ascend, exchanged.
fn exchanged(root: &Node, changes: Vec<(std::ops::Range<usize>, String)>) -> String {
    let text = root.text.text.as_str();
    let (mut out, mut done) = (String::with_capacity(text.len() + 80), 0);
    for (range, new) in changes {
        out += &text[done..range.start];
        out += &new;
        done = range.end;
    }
    out + &text[done..]
}
