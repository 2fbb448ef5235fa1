//! Scenes by name.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Severity};
use super::suggest::known_names;
use super::text::cannot_read;
use crate::files::{self, NoFile};

/// The scene file that a path or a name means: a file, or `NAME.ron` in one of the folders of scenes.
///
/// Those are `assets/scenes` of the current folder, of the source tree this was built from, and beside the executable.
pub fn find(name_or_path: &str) -> Result<PathBuf, Diagnostic> {
    let path = Path::new(name_or_path);
    let error = match files::regular(path) {
        Ok(_) => return Ok(path.to_path_buf()),
        Err(error) => error,
    };
    let known = known_scenes();
    if let Some(found) = known.get(name_or_path.strip_suffix(".ron").unwrap_or(name_or_path)) {
        return Ok(found.clone());
    }
    let none = |message: String| Diagnostic::file(Severity::Error, path, message);
    match NoFile::of(&error) {
        Some(NoFile::Folder) => {
            let help = "name a scene file (.ron) or a model (.obj) in it";
            return Err(none("this is a folder, not a scene".into()).help(help));
        }
        Some(_) => return Err(cannot_read(path, &error)),
        None => {}
    }
    let names = known_names(name_or_path, known.keys().map(String::as_str));
    if path.extension().is_some() || path.components().count() > 1 {
        return Err(none("there is no such file".into()).help(format!("or name a scene; {names}")));
    }
    Err(none(format!("there is no scene `{name_or_path}`")).help(names))
}

/// The names of all scenes in the folders of scenes, in order.
pub fn names() -> Vec<String> {
    known_scenes().into_keys().collect()
}

/// Every scene in the folders of scenes, by name; the first folder that has a name wins.
fn known_scenes() -> BTreeMap<String, PathBuf> {
    let mut known = BTreeMap::new();
    for folder in folders() {
        let is_scene = |path: &Path| path.extension().is_some_and(|extension| extension == "ron");
        let Ok(found) = files::walk(&folder, 0, is_scene) else { continue };
        for path in found.files {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            known.entry(stem).or_insert(path);
        }
    }
    known
}

/// The folders of scenes, in the order they are searched.
fn folders() -> Vec<PathBuf> {
    let executable = std::env::current_exe().ok().and_then(|path| path.parent().map(Path::to_path_buf));
    let roots = [Some(PathBuf::new()), Some(PathBuf::from(env!("CARGO_MANIFEST_DIR"))), executable];
    roots.into_iter().flatten().map(|root| root.join("assets/scenes")).collect()
}
