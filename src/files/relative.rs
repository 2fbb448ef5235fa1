//! The path of a file as another file is to name it.

use std::path::{Component, Path, PathBuf};

/// A file's path from a folder, with `/` between its parts; whole where no path leads from the one to the other, as between drives.
pub fn relative(file: &Path, folder: &Path) -> String {
    let absolute = |path: &Path| {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        path.canonicalize().or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_path_buf())
    };
    // The file's own name stays, also where it is a link.
    let from = absolute(folder);
    let to = absolute(file.parent().unwrap_or(Path::new("")));
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let first = |path: &Path| path.components().next().is_some_and(|part| matches!(part, Component::Prefix(_)));
    let up = from.components().skip(common).map(|_| Component::ParentDir);
    let mut path: PathBuf = match common == 0 && (first(&from) || first(&to)) {
        true => to,
        false => up.chain(to.components().skip(common)).collect(),
    };
    path.extend(file.file_name());
    path.display().to_string().replace('\\', "/")
}
