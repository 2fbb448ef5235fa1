//! Files that appear whole or not at all: written beside their place under another name, then renamed.
//!
//! A link stays a link: what it leads to is written.

use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Links that are followed from one to the next; systems follow 40.
const MOST_LINKS: usize = 40;

/// The files that are not whole yet, by their other names.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Keeps a file on that list.
struct Unfinished(PathBuf);

impl Unfinished {
    fn list(path: &Path) -> Self {
        unfinished().push(path.to_path_buf());
        Self(path.to_path_buf())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
    }
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that are not whole: for a process that ends at once.
pub fn remove_unfinished() {
    unfinished().iter().for_each(|path| drop(std::fs::remove_file(path)));
}

/// Why a file could not be written. Each names the file and says what to do.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SaveError {
    #[error("{}: the extension says nothing that can be written", .0.display())]
    #[diagnostic(help("end the name in .png, .exr or .json"))]
    Extension(PathBuf),
    #[error("{}: is a folder", .0.display())]
    #[diagnostic(help("name a file in it"))]
    IsFolder(PathBuf),
    #[error("{}: is a pipe or a device, not a file", .0.display())]
    #[diagnostic(help("choose another place"))]
    NoFile(PathBuf),
    #[error("{}: is a link that leads to no end", .0.display())]
    #[diagnostic(help("remove the link, or choose another place"))]
    Loop(PathBuf),
    #[error("{} and {} are the same file", .0.display(), .1.display())]
    #[diagnostic(help("give each kind of file a place of its own"))]
    Same(PathBuf, PathBuf),
    #[error("{}: is one of the files that are read: it would be lost", .0.display())]
    #[diagnostic(help("choose another place"))]
    Input(PathBuf),
    #[error("{}: can't make the folder: {source}", folder.display())]
    #[diagnostic(help("choose another place"))]
    Folder { folder: PathBuf, source: std::io::Error },
    #[error("{}: can't write: {source}", path.display())]
    #[diagnostic(help("make room there, or choose another place"))]
    Write { path: PathBuf, source: std::io::Error },
}

impl SaveError {
    /// Whether all would be well in another place.
    pub fn is_of_place(&self) -> bool {
        !matches!(self, Self::Extension(_) | Self::IsFolder(_) | Self::Same(..))
    }
}

/// Makes missing folders and tries whether a file can be written there, so that a long render can't end in a refusal.
/// Returns the place: where the file is, with all links followed.
pub fn prepare(path: &Path) -> Result<PathBuf, SaveError> {
    let place = place(path)?;
    temporary(&place).map_err(|source| failed(path, source))?;
    let folder = std::fs::canonicalize(folder(&place)).map_err(|source| failed(path, source))?;
    Ok(folder.join(place.file_name().unwrap_or_default()))
}

/// Whether a place, with all links followed, is that of one of some files.
pub fn is_among(place: &Path, files: &[PathBuf]) -> bool {
    files.iter().any(|file| std::fs::canonicalize(file).is_ok_and(|real| real == place))
}

/// Writes a file by `content`, and makes the folders it lacks.
pub fn write(path: &Path, content: impl FnOnce(&mut BufWriter<&File>) -> std::io::Result<()>) -> Result<(), SaveError> {
    let place = place(path)?;
    write_whole(&place, content).map_err(|source| failed(path, source))
}

/// Writes a file by `content` where there is none of that name, and makes the folders it lacks. False where there is one.
pub fn write_new(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<&File>) -> std::io::Result<()>,
) -> Result<bool, SaveError> {
    let folder = folder(path);
    std::fs::create_dir_all(folder).map_err(|source| SaveError::Folder { folder: folder.to_path_buf(), source })?;
    let file = written(path, content).map_err(|source| failed(path, source))?;
    match file.persist_noclobber(path) {
        Ok(_) => Ok(true),
        Err(refused) if refused.error.kind() == ErrorKind::AlreadyExists => Ok(false),
        Err(refused) => Err(failed(path, refused.error)),
    }
}

/// Writes a file of text.
pub fn write_text(path: &Path, text: &str) -> Result<(), SaveError> {
    write(path, |out| out.write_all(text.as_bytes()))
}

fn write_whole(
    place: &Path,
    content: impl FnOnce(&mut BufWriter<&File>) -> std::io::Result<()>,
) -> std::io::Result<()> {
    written(place, content)?.persist(place).map_err(|failed| failed.error)?;
    Ok(())
}

/// The whole file under another name.
fn written(
    place: &Path,
    content: impl FnOnce(&mut BufWriter<&File>) -> std::io::Result<()>,
) -> std::io::Result<tempfile::NamedTempFile> {
    let file = temporary(place)?;
    let _unfinished = Unfinished::list(file.path());
    let mut out = BufWriter::new(file.as_file());
    content(&mut out)?;
    out.flush()?;
    drop(out);
    if let Ok(metadata) = std::fs::metadata(place) {
        // A file that gives way to another one leaves it its permissions.
        file.as_file().set_permissions(metadata.permissions())?;
    }
    file.as_file().sync_data()?;
    Ok(file)
}

/// What a path leads to, in a folder that is there: a file, or a name that is free.
fn place(path: &Path) -> Result<PathBuf, SaveError> {
    let place = target(path)?;
    let folder = folder(&place);
    std::fs::create_dir_all(folder).map_err(|source| SaveError::Folder { folder: folder.to_path_buf(), source })?;
    match std::fs::metadata(&place) {
        Ok(metadata) if metadata.is_dir() => Err(SaveError::IsFolder(path.to_path_buf())),
        Ok(metadata) if !metadata.is_file() => Err(SaveError::NoFile(path.to_path_buf())),
        _ => Ok(place),
    }
}

/// Follows links to what is none. What the last one leads to need not be there.
fn target(path: &Path) -> Result<PathBuf, SaveError> {
    let mut place = path.to_path_buf();
    for _ in 0..=MOST_LINKS {
        match std::fs::symlink_metadata(&place) {
            Ok(metadata) if metadata.is_symlink() => {
                let next = std::fs::read_link(&place).map_err(|source| failed(path, source))?;
                place = folder(&place).join(next);
            }
            // Whatever else is wrong is told by who writes.
            _ => return Ok(place),
        }
    }
    Err(SaveError::Loop(path.to_path_buf()))
}

/// A file of another name in the same folder, removed unless it is renamed. Others may read it, as far as the user's
/// mask of permissions says.
fn temporary(place: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lucerna-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder(place))
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn failed(path: &Path, source: std::io::Error) -> SaveError {
    SaveError::Write { path: path.to_path_buf(), source }
}
