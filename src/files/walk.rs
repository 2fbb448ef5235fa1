//! The walk through a folder and those below it, for all that looks for files: the build script too, so std is all it knows.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Folders within folders that are looked into.
pub const DEEPEST: usize = 32;

/// Folders that a walk looks into, in all.
const MOST_FOLDERS: usize = 100_000;

/// Names by which one folder is met: links between neighbours make more of them than there is time for.
const MOST_NAMES: u32 = 8;

/// What is in a folder and those below it. Paths begin with the folder as it was named.
#[derive(Debug, Default)]
pub struct Walk {
    /// The regular files of wanted names, sorted; also links of such names to what is not there or can't be reached, since
    /// whoever opens one is told why.
    pub files: Vec<PathBuf>,
    /// The folders that were read.
    pub folders: Vec<PathBuf>,
    /// The folders below that can't be read, and why. They are passed over.
    pub unread: Vec<(PathBuf, io::Error)>,
}

/// A folder to be read.
struct Folder {
    path: PathBuf,
    /// Its real path, after those of the folders it was reached through.
    way: Vec<PathBuf>,
}

/// Looks for files whose names are `wanted`, through links, at most `deepest` folders below `root`.
///
/// Passed over: hidden files and those that editors keep beside the real ones; FIFOs, sockets, devices; links that lead round in a
/// circle, be it to themselves or to a folder they are in. Fails only where `root` itself can't be read, or has no end.
pub fn walk(root: &Path, deepest: usize, wanted: impl Fn(&Path) -> bool) -> io::Result<Walk> {
    let mut walk = Walk::default();
    let mut met: HashMap<PathBuf, u32> = HashMap::new();
    let first = Folder { path: root.to_path_buf(), way: vec![fs::canonicalize(root)?] };
    // Links come last, so that every folder is met by its own name.
    let (mut folders, mut linked) = (vec![first], Vec::new());
    while let Some(folder) = folders.pop().or_else(|| linked.pop()) {
        let entries = match fs::read_dir(&folder.path) {
            Ok(entries) => entries,
            Err(error) if walk.folders.is_empty() => return Err(error),
            Err(error) => {
                walk.unread.push((folder.path, error));
                continue;
            }
        };
        if walk.folders.len() == MOST_FOLDERS {
            return Err(io::Error::other(format!("more than {MOST_FOLDERS} folders are below it")));
        }
        for entry in entries.flatten().filter(|entry| !is_kept_aside(&entry.file_name())) {
            let path = entry.path();
            let is_link = entry.file_type().is_ok_and(|kind| kind.is_symlink());
            match fs::metadata(&path) {
                Ok(metadata) if metadata.is_file() => walk.files.extend(wanted(&path).then_some(path)),
                Ok(metadata) if metadata.is_dir() && folder.way.len() <= deepest => {
                    let list = if is_link { &mut linked } else { &mut folders };
                    list.extend(below(&folder, path, &mut met));
                }
                Ok(_) => {}
                Err(error) => {
                    let lost = matches!(error.kind(), ErrorKind::NotFound | ErrorKind::PermissionDenied);
                    walk.files.extend((is_link && lost && wanted(&path)).then_some(path));
                }
            }
        }
        walk.folders.push(folder.path);
    }
    walk.files.sort();
    Ok(walk)
}

/// A folder below another; none where it is one that the way there led through, or holds such a one.
fn below(above: &Folder, path: PathBuf, met: &mut HashMap<PathBuf, u32>) -> Option<Folder> {
    let real = fs::canonicalize(&path).ok()?;
    if above.way.iter().any(|passed| passed.starts_with(&real)) {
        return None;
    }
    let names = met.entry(real.clone()).or_default();
    *names += 1;
    if *names > MOST_NAMES {
        return None;
    }
    let mut way = above.way.clone();
    way.push(real);
    Some(Folder { path, way })
}

/// Whether a name is that of a file which is hidden, or which an editor keeps beside the one that is edited: `.x.swp`, `.#x`, `._x`,
/// `#x#`, `x~`, `~$x`, `flycheck_x`, `x_flymake`.
fn is_kept_aside(name: &OsStr) -> bool {
    let stem = Path::new(name).file_stem().unwrap_or(name).as_encoded_bytes();
    let name = name.as_encoded_bytes();
    name.starts_with(b".")
        || name.ends_with(b"~")
        || name.starts_with(b"~$")
        || name.starts_with(b"#") && name.ends_with(b"#")
        || stem.starts_with(b"flycheck_")
        || stem.ends_with(b"_flymake")
}
