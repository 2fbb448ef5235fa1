//! The material libraries of an OBJ file: which files its statements mean, and what is in them.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::faces::Group;
use crate::scene::assets::Assets;
use crate::scene::diagnostic::{Diagnostic, Diagnostics};
use crate::scene::locate::{Located, as_written, file_names, locate};
use crate::scene::mtl::{MtlMaterial, read_mtl};
use crate::scene::suggest::known_names;
use crate::scene::text::{lenient, missing};

/// An `mtllib` statement.
#[derive(Debug)]
pub struct Statement {
    /// All that it names: one file or several, whose names may have spaces.
    pub names: String,
    /// A warning about `names` that lacks its message.
    pub place: Diagnostic,
}

/// The materials of a model's libraries.
pub struct Libraries<'s> {
    assets: &'s Assets,
    pub materials: BTreeMap<String, MtlMaterial>,
    /// The library that each material is of.
    pub sources: BTreeMap<String, Arc<Path>>,
    /// By the files that maps name: the first statement that does, as a warning without its message.
    pub map_places: BTreeMap<PathBuf, Diagnostic>,
    read: BTreeSet<PathBuf>,
    missing: bool,
}

/// Words of which each may be a library by itself.
const MAX_WORDS: usize = 64;

/// Libraries that the statements of a file may name, in all.
pub const MAX_LIBRARIES: usize = 1024;

impl<'s> Libraries<'s> {
    /// Reads what the statements name. Where nothing of that is there, and `groups` use materials: the library of the OBJ file's own
    /// name. `files` gets all that was read or looked for.
    pub fn read(
        obj: &Path,
        statements: &[Statement],
        groups: &[Group],
        assets: &'s Assets,
        diagnostics: &mut Diagnostics,
        files: &mut Vec<PathBuf>,
    ) -> Self {
        let mut this = Self {
            assets,
            materials: BTreeMap::new(),
            sources: BTreeMap::new(),
            map_places: BTreeMap::new(),
            read: BTreeSet::new(),
            missing: false,
        };
        let folder = obj.parent().unwrap_or(Path::new(""));
        let mut count = 0;
        for statement in statements {
            for (name, place) in names(folder, statement) {
                count += 1;
                if count > MAX_LIBRARIES {
                    let message = format!("more than {MAX_LIBRARIES} material libraries: the others are left out");
                    diagnostics.push(Diagnostic { message, ..place });
                    return this;
                }
                this.add(folder, &name, &place, diagnostics, files);
            }
        }
        let used = groups.iter().find_map(|group| group.material.as_ref());
        if let (true, Some((name, place))) = (this.read.is_empty(), used)
            && let Some(found) = own_library(folder, obj)
        {
            let why = match statements {
                [] => format!("no library has a material `{name}`, for no `mtllib` names one"),
                _ => "no library that is named is here".to_owned(),
            };
            let message = format!("{why}: `{}`, of the model's own name, is read", shown(&found));
            diagnostics.push(Diagnostic { message, ..place.clone() });
            this.take(found.path, diagnostics, files);
        }
        this
    }

    /// Whether a material that is not here was looked for in libraries that all are known.
    pub fn are_known(&self) -> bool {
        !self.missing || !self.materials.is_empty()
    }

    /// Adds the library of a name.
    fn add(
        &mut self,
        folder: &Path,
        name: &str,
        place: &Diagnostic,
        diagnostics: &mut Diagnostics,
        files: &mut Vec<PathBuf>,
    ) {
        let Some(found) = locate(folder, name) else {
            self.missing = true;
            let path = as_written(folder, name);
            let message = missing("material library", &path);
            files.push(path);
            let help = format!(
                "its materials are rendered grey, unless another library has them; {}",
                alternatives(folder, name)
            );
            return diagnostics.push(Diagnostic { message, ..place.clone() }.help(help));
        };
        if let Some(why) = found.differs {
            let message = format!("there is no `{name}`: `{}` is read, {why}", shown(&found));
            diagnostics.push(Diagnostic { message, ..place.clone() });
        }
        self.take(found.path, diagnostics, files);
    }

    /// Reads one library, if it was not read before. Of materials of one name, the first counts.
    fn take(&mut self, path: PathBuf, diagnostics: &mut Diagnostics, files: &mut Vec<PathBuf>) {
        if !self.read.insert(path.clone()) {
            return;
        }
        files.push(path.clone());
        let read = self.assets.library(&path, || {
            let mut messages = Diagnostics::default();
            (read_mtl(&path, &mut messages), messages)
        });
        let (library, messages) = &*read;
        diagnostics.list.extend(messages.list.iter().cloned());
        let Some(library) = library else { return };
        for (file, place) in &library.map_places {
            self.map_places.entry(file.clone()).or_insert_with(|| place.clone());
        }
        let source: Arc<Path> = path.into();
        for (name, material) in &library.materials {
            self.sources.entry(name.clone()).or_insert_with(|| source.clone());
            self.materials.entry(name.clone()).or_insert_with(|| material.clone());
        }
    }
}

/// The names of a statement, each with its place: those in quotes; else all of it, if there is such a file; else one name up to
/// each `.mtl`; else one a word.
fn names(folder: &Path, statement: &Statement) -> Vec<(String, Diagnostic)> {
    let all = statement.names.trim();
    let place = |part: &str| {
        let before = statement.names[..part.as_ptr() as usize - statement.names.as_ptr() as usize].chars().count();
        let column = statement.place.column.saturating_add(before as u32);
        (part.trim().to_owned(), Diagnostic { column, ..statement.place.clone() })
    };
    if as_written(folder, all).is_file() {
        return vec![place(all)];
    }
    let mut list = Vec::new();
    // Every second part stands between quotes.
    for (i, part) in all.split('"').enumerate().filter(|(_, part)| !part.trim().is_empty()) {
        if i % 2 == 1 {
            list.push(place(part.trim()));
            continue;
        }
        for name in up_to_endings(part).into_iter().take_while(|name| !name.starts_with('#')) {
            let words: Vec<&str> = name.split_whitespace().collect();
            let apart = (2..=MAX_WORDS).contains(&words.len())
                && locate(folder, name).is_none()
                && words.iter().any(|word| locate(folder, word).is_some());
            list.extend(if apart { words } else { vec![name] }.into_iter().map(place));
            if list.len() > MAX_LIBRARIES {
                return list;
            }
        }
    }
    list
}

/// Cuts behind each word that ends in `.mtl`.
fn up_to_endings(text: &str) -> Vec<&str> {
    let mut names = Vec::new();
    let mut rest = text.trim();
    while !rest.is_empty() {
        let end = rest
            .split_whitespace()
            .find(|word| {
                word.len() >= 4
                    && word.is_char_boundary(word.len() - 4)
                    && word[word.len() - 4..].eq_ignore_ascii_case(".mtl")
            })
            .map_or(rest.len(), |word| word.as_ptr() as usize - rest.as_ptr() as usize + word.len());
        names.push(rest[..end].trim());
        rest = rest[end..].trim_start();
    }
    names
}

/// `model.mtl` beside `model.obj`, or `model.obj.mtl`.
fn own_library(folder: &Path, obj: &Path) -> Option<Located> {
    let text = |name: &OsStr| lenient(name.as_encoded_bytes());
    let stem = obj.file_stem()?;
    let names = [text(stem), text(obj.file_name()?), text(Path::new(stem).file_stem()?)];
    names.iter().find_map(|name| locate(folder, &format!("{name}.mtl")))
}

/// What is beside a missing library.
fn alternatives(folder: &Path, name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let names = file_names(folder);
    let known: Vec<&str> = names
        .iter()
        .map(String::as_str)
        .filter(|name| Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtl")))
        .collect();
    if known.is_empty() {
        return "the path is relative to the folder of the OBJ file".into();
    }
    known_names(last, known)
}

/// A found file's own name.
fn shown(found: &Located) -> String {
    found.path.display().to_string()
}
