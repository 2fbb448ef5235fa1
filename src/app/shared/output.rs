//! Results go to stdout, and a reader that has gone is no error; pictures go to files.

use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

use super::failure::{Failure, show};
use crate::image::{Output, Outputs, SaveError};

/// The flag that names a picture's file.
pub const FILE_FLAG: &str = "-o FILE";

/// The flag that names a folder of several files.
pub const FOLDER_FLAG: &str = "--out DIR";

/// stdout could not be written, for another reason than that nobody reads it.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("can't write to stdout: {0}")]
pub struct Unwritten(std::io::Error);

/// Writes text to stdout. A closed pipe is taken as "enough".
pub fn write(text: &str) -> Result<(), Unwritten> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(Unwritten),
    }
}

/// Writes a result to stdout.
pub fn print(text: &str) -> Result<(), Failure> {
    write(text).map_err(Failure::of)
}

/// Prints a line to stderr, if anybody is there.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// A file that can't be written, and the flag that names another place.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct Unplaced {
    error: SaveError,
    flag: &'static str,
}

impl Unplaced {
    /// By the flag that says where the file goes.
    pub fn by(flag: &'static str) -> impl Fn(SaveError) -> Self {
        move |error| Self { error, flag }
    }
}

impl miette::Diagnostic for Unplaced {
    fn help(&self) -> Option<Box<dyn Display + '_>> {
        let help = self.error.help()?;
        Some(if self.error.is_of_place() { Box::new(format!("{help} with {}", self.flag)) } else { help })
    }
}

/// Shows why files could not be written, and says whether all were.
pub fn all_written(failures: Vec<SaveError>) -> bool {
    let whole = failures.is_empty();
    failures.into_iter().map(Unplaced::by(FILE_FLAG)).for_each(|failure| show(&failure));
    whole
}

/// Tries the places of files that are to be written, and reports those where none can be, or where one is that is `read`. Says
/// whether all can; fails if none can.
pub fn prepare(outputs: &[Output], read: &[PathBuf]) -> Result<(Outputs, bool), Failure> {
    let (outputs, mut failures) = Outputs::prepare(outputs, read);
    let last = if outputs.is_empty() { failures.pop() } else { None };
    let whole = all_written(failures);
    match last {
        Some(failure) => Err(Failure::of(Unplaced::by(FILE_FLAG)(failure))),
        None => Ok((outputs, whole)),
    }
}
