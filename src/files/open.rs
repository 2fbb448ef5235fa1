//! Opening what people name: a regular file, or a refusal at once. Nothing waits for a FIFO's other end, or reads a device.

use std::fs::{self, File, FileType, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Links that are followed from one to the next, as the system does it.
const LONGEST_CHAIN: usize = 40;

/// Why a path is that of no file. [`NoFile::of`] finds it in the errors of this module.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoFile {
    #[error("this is a folder, not a file")]
    Folder,
    /// By its name with an article: a FIFO, a socket, a device.
    #[error("this is {0}, not a file")]
    Special(&'static str),
    #[error("`{}` is a link to `{}`, which does not exist", link.display(), target.display())]
    Dangling { link: PathBuf, target: PathBuf },
    #[error("`{}` is a link to `{}`, which leads back to it", link.display(), target.display())]
    Loop { link: PathBuf, target: PathBuf },
}

impl NoFile {
    /// What an error of this module is about, if it is more than what the system says.
    pub fn of(error: &io::Error) -> Option<&Self> {
        error.get_ref()?.downcast_ref()
    }

    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            NoFile::Folder => "name a file in it",
            NoFile::Special(_) => "name a regular file: what programs pass on is to be written to one first",
            NoFile::Dangling { .. } => "restore the link's target, or have the link lead to where it is now",
            NoFile::Loop { .. } => "have the link lead to a file",
        }
    }
}

impl From<NoFile> for io::Error {
    fn from(why: NoFile) -> Self {
        let kind = match why {
            NoFile::Folder => ErrorKind::IsADirectory,
            NoFile::Dangling { .. } => ErrorKind::NotFound,
            NoFile::Special(_) | NoFile::Loop { .. } => ErrorKind::InvalidInput,
        };
        io::Error::new(kind, why)
    }
}

/// Opens a regular file for reading, through links. Never waits: what has another kind is refused, also if it takes the file's
/// place just now.
pub fn open_regular(path: &Path) -> io::Result<File> {
    regular(path)?;
    let mut options = OpenOptions::new();
    options.read(true);
    // A FIFO without a writer would be waited for; regular files know no such flag.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK);
    let file = options.open(path)?;
    refuse_others(&file.metadata()?)?;
    Ok(file)
}

/// The metadata of a regular file; else why it is none.
pub fn regular(path: &Path) -> io::Result<Metadata> {
    let metadata = fs::metadata(path).map_err(|error| explained(path, error))?;
    refuse_others(&metadata)?;
    Ok(metadata)
}

/// Reads a regular file of at most `limit` bytes.
pub fn read(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > limit {
        true => Err(io::Error::new(ErrorKind::FileTooLarge, format!("it has more than {limit} bytes"))),
        false => Ok(bytes),
    }
}

/// An error about a path; where a link on the way leads nowhere, the error names the link and its target.
pub fn explained(path: &Path, error: io::Error) -> io::Error {
    for link in path.ancestors() {
        // The nearest link that leads nowhere is the one to be mended.
        if let (Ok(target), true) = (fs::read_link(link), fs::metadata(link).is_err()) {
            let (link, why) = (link.to_path_buf(), leads_to(link));
            return match why {
                Some(Ok(target)) => NoFile::Dangling { link, target }.into(),
                Some(Err(())) => NoFile::Loop { link, target }.into(),
                None => error,
            };
        }
    }
    error
}

/// Where a chain of links ends that leads to nothing; an error if it has no end. None if there is something.
fn leads_to(link: &Path) -> Option<Result<PathBuf, ()>> {
    let mut at = link.to_path_buf();
    for _ in 0..LONGEST_CHAIN {
        match fs::read_link(&at) {
            Ok(target) => at = at.parent().unwrap_or(Path::new("")).join(target),
            Err(error) if error.kind() == ErrorKind::NotFound => return Some(Ok(at)),
            Err(_) => return None,
        }
    }
    Some(Err(()))
}

fn refuse_others(metadata: &Metadata) -> io::Result<()> {
    match metadata.file_type() {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err(NoFile::Folder.into()),
        kind => Err(NoFile::Special(special(kind)).into()),
    }
}

#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match kind {
        _ if kind.is_fifo() => "a FIFO",
        _ if kind.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "a device"
}
