//! Files that other files name: written by another program, on another machine, in other letters.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::diagnostic::Diagnostic;
use super::suggest::did_you_mean;
use super::text::lenient;

/// A file that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Located {
    pub path: PathBuf,
    /// How it is another than the one that was named, where it is.
    pub differs: Option<&'static str>,
}

/// Bytes that a name may have.
const LONGEST: usize = 4096;

/// Folders of a name that are tried, counted from the file.
const PARTS: usize = 8;

/// The folder that paths are relative to: that of the file which writes them; for what the command line writes, the scene's.
pub fn folder_of<'p>(place: &'p Diagnostic, scene: &'p Path) -> &'p Path {
    let file = if place.file == Path::new("-D") { scene } else { &place.file };
    file.parent().unwrap_or(Path::new(""))
}

/// What paths are relative to, in words.
pub fn relative_to(place: &Diagnostic, scene: &Path) -> String {
    let of = if place.file == Path::new("-D") || place.file == scene { "the scene file" } else { "this file" };
    format!("the path is relative to the folder of {of}")
}

/// The path that a name means as it is written: `\` separates folders too, but before a space it only keeps words together.
pub fn as_written(folder: &Path, name: &str) -> PathBuf {
    folder.join(name.replace("\\ ", " ").replace('\\', "/"))
}

/// The file of a name: as it is written; else by letters of another case, if one file alone fits; else by the name's last parts,
/// since its folder may be one of another machine.
pub fn locate(folder: &Path, name: &str) -> Option<Located> {
    if name.is_empty() || name.len() > LONGEST {
        return None;
    }
    let path = as_written(folder, name);
    if path.is_file() {
        return Some(Located { path, differs: None });
    }
    let name = name.replace("\\ ", " ");
    let parts: Vec<&str> = name.split(['/', '\\']).filter(|part| !part.is_empty() && *part != ".").collect();
    let first = parts.len().saturating_sub(PARTS);
    (first..parts.len()).find_map(|skipped| {
        let (path, same_case) = walk(folder, &parts[skipped..])?;
        let differs = match (skipped, same_case) {
            (0, true) => None,
            (0, false) => Some("which is written in letters of another case"),
            _ => Some("since the folder it names is not here"),
        };
        Some(Located { path, differs })
    })
}

/// The names of the files in a folder, in order; none where it can't be read.
pub fn file_names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = entries(folder).into_iter().map(|(_, name)| name).collect();
    names.sort();
    names
}

/// "Did you mean", by what is in the folder that a missing file's name means; else by what is in the folder it is relative to.
pub fn near_names(folder: &Path, name: &str) -> Option<String> {
    let path = as_written(folder, name);
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let near = |folder: &Path| {
        let names = file_names(folder);
        // What is there under the same name is what can't be read.
        did_you_mean(last, names.iter().map(String::as_str).filter(|name| *name != last))
    };
    path.parent().and_then(near).or_else(|| near(folder))
}

/// The file at the end of a chain of names, and whether all have their letters' case.
fn walk(folder: &Path, parts: &[&str]) -> Option<(PathBuf, bool)> {
    let mut path = folder.to_path_buf();
    let mut same_case = true;
    for part in parts {
        let next = path.join(part);
        if *part == ".." || next.exists() {
            path = next;
            continue;
        }
        let (name, same) = entry(&path, part)?;
        path.push(name);
        same_case &= same;
    }
    path.is_file().then_some((path, same_case))
}

/// What a folder has under a name, which the system may hold in another encoding: and whether the letters' case is the same.
fn entry(folder: &Path, name: &str) -> Option<(OsString, bool)> {
    let all = entries(folder);
    if let Some((found, _)) = all.iter().find(|(_, other)| other == name) {
        return Some((found.clone(), true));
    }
    let lower = name.to_lowercase();
    let mut alike = all.into_iter().filter(|(_, other)| other.to_lowercase() == lower);
    let found = alike.next()?;
    alike.next().is_none().then_some((found.0, false))
}

/// All that a folder holds, with its name as text.
fn entries(folder: &Path) -> Vec<(OsString, String)> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let list = std::fs::read_dir(folder).into_iter().flatten().flatten();
    list.map(|entry| entry.file_name())
        .map(|name| {
            let text = lenient(name.as_encoded_bytes());
            (name, text)
        })
        .collect()
}

/// A file's name without folder and extension.
pub fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
