//! What tells, without reading a file, whether it may be another one than at the last look.

use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::regular;

/// A file as young as this may be written again without another time stamp, so that only its contents can tell.
const YOUNG: Duration = Duration::from_secs(2);

/// Two equal stamps of a path that are not young: the same file with the same contents.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
    /// Where links lead: the file of an old link and that of a new one may be equally long and old.
    real: PathBuf,
    /// Number of the file in its file system, where there are such numbers.
    number: u64,
}

impl Stamp {
    /// Of a regular file, through links.
    pub fn of(path: &Path) -> io::Result<Self> {
        let metadata = regular(path)?;
        #[cfg(unix)]
        let number = std::os::unix::fs::MetadataExt::ino(&metadata);
        #[cfg(not(unix))]
        let number = 0;
        Ok(Self { length: metadata.len(), modified: metadata.modified().ok(), real: path.canonicalize()?, number })
    }

    /// Whether the file may change again without changing its stamp.
    pub fn is_young(&self) -> bool {
        let age = self.modified.and_then(|time| SystemTime::now().duration_since(time).ok());
        age.is_none_or(|age| age <= YOUNG)
    }
}
