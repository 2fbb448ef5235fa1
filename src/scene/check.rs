//! Reads asset files for their messages alone.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::load::load;
use super::mtl::read_mtl;
use super::obj::read_obj;
use super::text::cannot_read;
use crate::files;

/// What a check has read and found.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// The assets that were checked, sorted.
    pub files: Vec<PathBuf>,
    pub diagnostics: Diagnostics,
}

/// Checks an asset file (.obj, .mtl, .ron), or every one in a folder and the folders below it.
///
/// A message that several files lead to (a scene and the model it names) is kept once.
pub fn check(path: &Path) -> Checked {
    let mut checked = Checked::default();
    if path.is_dir() && !is_asset(path) {
        collect(path, &mut checked);
        if checked.files.is_empty() && !checked.diagnostics.has_errors() {
            let warning = Diagnostic::file(Severity::Warning, path, "there is no asset in this folder");
            checked.diagnostics.push(warning.help(KINDS));
        }
    } else {
        checked.files.push(path.to_path_buf());
    }
    let mut seen = BTreeSet::new();
    for file in &checked.files {
        for diagnostic in check_file(file) {
            if seen.insert((diagnostic.file.clone(), diagnostic.line, diagnostic.column, diagnostic.message.clone())) {
                checked.diagnostics.push(diagnostic);
            }
        }
    }
    checked
}

/// What can be checked.
const KINDS: &str = "assets are .ron (scenes), .obj (models) and .mtl (materials)";

/// Adds the asset files of a folder and those below it.
fn collect(folder: &Path, checked: &mut Checked) {
    match files::walk(folder, files::DEEPEST, is_asset) {
        Ok(found) => {
            checked.files = found.files;
            checked.diagnostics.list.extend(found.unread.iter().map(|(path, error)| cannot_read(path, error)));
        }
        Err(error) => checked.diagnostics.push(cannot_read(folder, &files::explained(folder, error))),
    }
}

/// The messages of one file.
fn check_file(path: &Path) -> Diagnostics {
    let mut diagnostics = Diagnostics::default();
    let mut files = Vec::new();
    match extension(path).as_str() {
        "ron" => match load(path, &[]) {
            Ok(loaded) => diagnostics.list = loaded.warnings,
            Err(errors) => diagnostics = errors,
        },
        "obj" => {
            read_obj(path, &mut diagnostics, &mut files);
        }
        "mtl" => {
            read_mtl(path, &mut diagnostics);
        }
        _ => {
            let message = "can't check this kind of file";
            diagnostics.push(Diagnostic::file(Severity::Error, path, message).help(KINDS));
        }
    }
    diagnostics
}

/// Whether a path has the name of an asset.
fn is_asset(path: &Path) -> bool {
    matches!(extension(path).as_str(), "obj" | "mtl" | "ron")
}

/// A file's extension in small letters.
fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}
