//! Results go to stdout, and a reader that has gone is no error; pictures go to files.

use std::io::{ErrorKind, Write};
use std::path::PathBuf;

use super::failure::{Failure, show};
use crate::image::{Output, Outputs};

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

/// Tries the places of files that are to be written, and reports those where none can be, or where one is that is `read`. Says
/// whether all can; fails if none can.
pub fn prepare(outputs: &[Output], read: &[PathBuf]) -> Result<(Outputs, bool), Failure> {
    let (outputs, mut failures) = Outputs::prepare(outputs, read);
    let last = if outputs.is_empty() { failures.pop() } else { None };
    failures.iter().for_each(|failure| show(failure));
    match last {
        Some(failure) => Err(failure.into()),
        None => Ok((outputs, failures.is_empty())),
    }
}
