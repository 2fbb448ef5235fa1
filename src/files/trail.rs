//! The folders in which something can happen that makes a path mean another file.

use std::collections::{BTreeSet, VecDeque};
use std::ffi::OsString;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Links that are followed before a path is taken for one that has no end.
const MOST_LINKS: usize = 40;

/// The folder that holds a file itself, and that of each link on the way to it: a link may be made to lead elsewhere. All as real
/// paths, but for what does not exist.
pub fn trail(path: &Path) -> BTreeSet<PathBuf> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let mut folders = BTreeSet::new();
    let mut rest: VecDeque<OsString> = parts(&path);
    // The way so far, without links.
    let mut at = PathBuf::new();
    let mut links = 0;
    while let Some(part) = rest.pop_front() {
        match Path::new(&part).components().next() {
            Some(Component::ParentDir) => {
                at.pop();
                continue;
            }
            Some(Component::CurDir) | None => continue,
            Some(Component::Prefix(_) | Component::RootDir) => {
                // A link's target from the root on: what came before does not count.
                at.push(part);
                continue;
            }
            Some(Component::Normal(_)) => {}
        }
        let next = at.join(&part);
        match fs::read_link(&next) {
            Ok(target) if links < MOST_LINKS => {
                links += 1;
                folders.insert(at.clone());
                for part in parts(&target).into_iter().rev() {
                    rest.push_front(part);
                }
            }
            _ => at = next,
        }
    }
    folders.extend(at.parent().map(Path::to_path_buf));
    folders
}

fn parts(path: &Path) -> VecDeque<OsString> {
    path.components().map(|part| part.as_os_str().to_owned()).collect()
}
