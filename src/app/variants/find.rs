//! Where a variant file is.

use std::path::{Path, PathBuf};

use crate::scene::{Diagnostic, Severity, did_you_mean};

/// Where those are that can be named without path and ending.
const FOLDER: &str = "assets/variants";

/// The file of a path, or of a name in assets/variants.
pub fn find(name: &str) -> Result<PathBuf, Diagnostic> {
    let path = PathBuf::from(name);
    let named = Path::new(FOLDER).join(format!("{name}.ron"));
    if path.is_file() {
        return Ok(path);
    }
    if named.is_file() {
        return Ok(named);
    }
    let mut names: Vec<String> = std::fs::read_dir(FOLDER)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ron"))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    let near = did_you_mean(name, names.iter().map(String::as_str));
    let help = match names.is_empty() {
        _ if near.is_some() => near.unwrap_or_default(),
        true => "give the path of a variant file (.ron)".to_owned(),
        false => format!("give the path of a variant file (.ron), or one of these names: {}", names.join(", ")),
    };
    Err(Diagnostic::file(Severity::Error, &path, "there is no such variant file").help(help))
}
