//! Files that extend others: the chain of them, and what their trees come to.

use std::path::{Path, PathBuf};

use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::locate::near_names;
use crate::scene::ron::{Kind, Node};
use crate::scene::text::missing;

/// The longest chain of files that extend each other.
const LONGEST: usize = 16;

/// Fields that a variant file has, and a scene file does not.
const OF_FAMILIES: [&str; 5] = ["overrides", "sweep", "members", "reference", "goal"];

/// The files from one on, each extended by the one before.
pub struct Chain {
    /// As named.
    files: Vec<PathBuf>,
}

impl Chain {
    pub fn new(first: &Path) -> Self {
        Self { files: vec![first.to_path_buf()] }
    }

    /// The file that the last one extends, which the chain has from here on.
    pub fn add(&mut self, extends: &Extends) -> Result<PathBuf, Diagnostic> {
        let error = |message: String| Diagnostic { message, ..extends.place.clone() };
        let folder = extends.place.file.parent().unwrap_or(Path::new(""));
        let path = folder.join(extends.name.replace('\\', "/"));
        if !path.is_file() {
            let help = near_names(folder, &extends.name)
                .unwrap_or_else(|| "the path is relative to the folder of this file".to_owned());
            return Err(error(missing("file", &path)).help(help));
        }
        let met = self.files.iter().position(|file| identity(file) == identity(&path));
        self.files.push(path.clone());
        if let Some(first) = met {
            let shown: Vec<String> = self.files[first..].iter().map(|file| name(file)).collect();
            return Err(error(format!("{}: this chain has no end", shown.join(" extends ")))
                .help("leave out one of these `extends`"));
        }
        if self.files.len() > LONGEST {
            return Err(error(format!("more than {LONGEST} files extend each other")));
        }
        Ok(path)
    }
}

/// The file that another one is extended from.
#[derive(Clone, Debug)]
pub struct Extends {
    /// As written: relative to the folder of the file that has it.
    pub name: String,
    /// An error about it, without its message.
    pub place: Diagnostic,
}

/// Takes `extends` out of a file's tree.
pub fn take_extends(root: &mut Node) -> Result<Option<Extends>, Diagnostic> {
    let Kind::Fields(fields) = &mut root.kind else { return Ok(None) };
    let Some(at) = fields.iter().position(|(name, ..)| name == "extends") else { return Ok(None) };
    let (_, _, node) = fields.remove(at);
    let error = |message: String| node.text.error(node.source, message);
    match node.string() {
        Ok(name) if name.is_empty() => Err(error("extends: expected the path of a file, found an empty string".into())),
        Ok(name) => Ok(Some(Extends { name, place: error(String::new()) })),
        Err(message) => Err(error(format!("extends: {message}"))),
    }
}

/// Whether a tree is that of a variant file.
pub fn is_of_family(root: &Node) -> bool {
    let Kind::Fields(fields) = &root.kind else { return false };
    fields.iter().any(|(name, ..)| OF_FAMILIES.contains(&name.as_str()))
}

/// The error about a variant file in the place of a scene.
pub fn no_scene(file: &Path) -> Diagnostic {
    Diagnostic::file(Severity::Error, file, "this is a variant file, not a scene")
        .help("`lucerna variants` renders its members, `lucerna view` opens it; a scene extends scenes only")
}

/// The field that a plain value at a path stands for.
type PlainField = fn(&[&str]) -> Option<&'static str>;

/// Writes a tree over another: fields are joined by their names, through variants of one name; all else is exchanged as a whole,
/// lists too.
pub fn merge<'a>(base: Node<'a>, over: Node<'a>, plain: PlainField) -> Node<'a> {
    let mut path = Vec::new();
    join(base, over, plain, &mut path)
}

fn join<'a>(base: Node<'a>, over: Node<'a>, plain: PlainField, path: &mut Vec<String>) -> Node<'a> {
    let Node { text, source, kind } = over;
    let kind = match (base.kind, kind) {
        (base @ Kind::Fields(_), Kind::Items(items)) if items.is_empty() && source.starts_with('(') => base,
        (Kind::Fields(fields), Kind::Fields(others)) => Kind::Fields(join_fields(fields, others, plain, path)),
        (Kind::Variant(name, Some(content)), Kind::Variant(other, Some(over))) if name == other => {
            Kind::Variant(name, Some(Box::new(join_contents(*content, *over, plain, path))))
        }
        (Kind::Scalar, Kind::Fields(others)) => {
            let parts: Vec<&str> = path.iter().map(String::as_str).collect();
            let field = plain(&parts).map(|field| {
                let value = Node { text: base.text, source: base.source, kind: Kind::Scalar };
                (field.to_owned(), base.source, value)
            });
            match field {
                Some(field) => Kind::Fields(join_fields(vec![field], others, plain, path)),
                None => Kind::Fields(others),
            }
        }
        (_, over) => over,
    };
    Node { text, source, kind }
}

/// Of variants: what stands alone in either is joined.
fn join_contents<'a>(mut base: Node<'a>, mut over: Node<'a>, plain: PlainField, path: &mut Vec<String>) -> Node<'a> {
    match (&mut base.kind, &mut over.kind) {
        (Kind::Items(items), Kind::Items(others)) if items.len() == 1 && others.len() == 1 => {
            *others = items.drain(..).zip(others.drain(..)).map(|(base, over)| join(base, over, plain, path)).collect();
            over
        }
        _ => join(base, over, plain, path),
    }
}

type Field<'a> = (String, &'a str, Node<'a>);

fn join_fields<'a>(
    mut fields: Vec<Field<'a>>,
    others: Vec<Field<'a>>,
    plain: PlainField,
    path: &mut Vec<String>,
) -> Vec<Field<'a>> {
    for (name, place, node) in others {
        match fields.iter().position(|(field, ..)| *field == name) {
            Some(at) => {
                let (name, _, base) = fields.remove(at);
                path.push(name);
                let node = join(base, node, plain, path);
                let name = path.pop().unwrap_or_default();
                fields.insert(at, (name, place, node));
            }
            None => fields.push((name, place, node)),
        }
    }
    fields
}

/// One path for each file, whatever it was reached by.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

/// A file's own name.
fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
