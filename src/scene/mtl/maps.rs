//! `map_*` statements: options, the name of a file, and for some programs options behind it.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use super::options::{self, Context, Given};
use super::texture_map::TextureMap;
use crate::scene::diagnostic::{Diagnostic, Tally};
use crate::scene::locate::{Located, as_written, locate, near_names};
use crate::scene::text::missing;

/// Signs of comments behind a name that are tried.
const COMMENTS: usize = 8;

/// The pictures that the maps of one library name.
pub struct MapFiles<'a> {
    /// Of the library.
    folder: &'a Path,
    /// What was looked for by each name.
    found: HashMap<String, Option<Located>>,
    /// The first statement that names a file, found or not: a warning that lacks its message.
    pub places: BTreeMap<PathBuf, Diagnostic>,
}

impl<'a> MapFiles<'a> {
    /// None yet.
    pub fn new(folder: &'a Path) -> Self {
        Self { folder, found: HashMap::new(), places: BTreeMap::new() }
    }

    /// The file of a name, if there is one.
    fn locate(&mut self, name: &str) -> Option<&Located> {
        if !self.found.contains_key(name) {
            self.found.insert(name.to_owned(), locate(self.folder, name));
        }
        self.found[name].as_ref()
    }

    /// The map of a statement; none where it names no file. A file that isn't there is told, and kept.
    pub fn read(&mut self, at: &Context, rest: &str, tally: &mut Tally) -> Option<TextureMap> {
        let (before, rest) = options::split(rest, true);
        let (name, behind) = self.name(rest);
        if name.is_empty() {
            let message = format!("`{}` names no file: it is left out", at.key);
            tally.push("maps without a file", || at.line.warning(at.key, message));
            return None;
        }
        if name.starts_with('-') && self.locate(name).is_none() {
            let message = format!("unknown option in `{name}`: this `{}` is left out", at.key);
            tally.push("map options", || at.line.warning(name, message));
            return None;
        }
        let mut map = TextureMap::new(self.file(at, name, tally));
        before.iter().chain(&behind).for_each(|given| at.apply(given, &mut map, tally));
        Some(map)
    }

    /// The name of a file at the start of a text, and the options behind it. A name may have spaces, `#`, and what looks like an
    /// option: of what it may be, the longest is taken that is a file.
    fn name<'t>(&mut self, text: &'t str) -> (&'t str, Vec<Given<'t>>) {
        if let Some((name, rest)) = text.strip_prefix('"').and_then(|quoted| quoted.split_once('"')) {
            return (name.trim(), options::split(rest, false).0);
        }
        let end = options::behind(text);
        let comments: Vec<usize> =
            text.match_indices(" #").chain(text.match_indices("\t#")).map(|(at, _)| at).collect();
        let mut cuts: Vec<usize> = comments.iter().copied().take(COMMENTS).chain(end).chain([text.len()]).collect();
        cuts.sort_unstable();
        let is_file = |cut: &usize| self.locate(text[..*cut].trim()).is_some();
        let shortest = end.or(comments.iter().copied().min()).unwrap_or(text.len());
        let cut = cuts.into_iter().rev().find(is_file).unwrap_or(shortest);
        let behind = if Some(cut) == end { options::split(&text[cut..], false).0 } else { Vec::new() };
        (text[..cut].trim().trim_matches('"').trim(), behind)
    }

    /// The file of a name, or where it was looked for. What there is to say of it is said where it is named first.
    fn file(&mut self, at: &Context, name: &str, tally: &mut Tally) -> PathBuf {
        let found = self.locate(name).cloned();
        let folder = self.folder;
        let path = found.as_ref().map_or_else(|| as_written(folder, name), |found| found.path.clone());
        if self.places.contains_key(&path) {
            return path;
        }
        self.places.insert(path.clone(), at.line.warning(name, ""));
        match found {
            Some(Located { differs: Some(why), .. }) => tally.push("images found by another name", || {
                at.line.warning(name, format!("there is no `{name}`: `{}` is read, {why}", path.display()))
            }),
            Some(_) => {}
            None => tally.push("missing images", || {
                let help = near_names(folder, name)
                    .unwrap_or_else(|| "the path is relative to the folder of the MTL file".to_owned());
                let warning = at.line.warning(name, missing("image", &path));
                warning.help(format!("`{}` is rendered without this map; {help}", at.key))
            }),
        }
        path
    }
}
