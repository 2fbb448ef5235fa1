//! A file that knows its end: what a decoder can't read because the file is cut short is told apart from what is damaged.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use super::error::Fault;
use crate::files::{self, NoFile};

/// A file, and whether more was asked of it than it has.
#[derive(Debug)]
pub struct Tail {
    file: File,
    ended: bool,
}

impl Tail {
    /// Opens a regular file for reading.
    pub fn open(path: &Path) -> Result<Self, Fault> {
        match files::open_regular(path) {
            Ok(file) => Ok(Self { file, ended: false }),
            Err(error) if NoFile::of(&error) == Some(&NoFile::Folder) => Err(Fault::Folder),
            Err(error) => Err(Fault::Open(error)),
        }
    }

    /// Bytes that the file has.
    pub fn length(&self) -> Result<u64, Fault> {
        Ok(self.file.metadata().map_err(Fault::Open)?.len())
    }

    /// What a decoder's error means: that the file is cut short, if the decoder came to its end.
    pub fn fault(&self, error: impl std::fmt::Display) -> Fault {
        if self.ended { Fault::CutShort } else { Fault::Broken(error.to_string()) }
    }
}

impl Read for Tail {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(bytes)?;
        self.ended |= count == 0 && !bytes.is_empty();
        Ok(count)
    }
}

impl Seek for Tail {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
