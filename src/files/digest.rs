//! What a file's contents come to.

use std::collections::hash_map::DefaultHasher;
use std::hash::Hasher;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use super::open_regular;

/// Bytes of a file, and their hash: the same in every process of one build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest {
    pub length: u64,
    pub hash: u64,
}

impl Digest {
    /// Of a regular file, through links.
    pub fn of(path: &Path) -> io::Result<Self> {
        let mut file = open_regular(path)?;
        let (mut hasher, mut length) = (DefaultHasher::new(), 0);
        let mut part = vec![0; 1 << 18];
        loop {
            match file.read(&mut part) {
                Ok(0) => return Ok(Self { length, hash: hasher.finish() }),
                Ok(read) => {
                    hasher.write(&part[..read]);
                    length += read as u64;
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}
