//! Results go to stdout, and a reader that has gone is no error.

use std::io::{ErrorKind, Write};

use super::Failure;

/// stdout could not be written, for another reason than that nobody reads it.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("can't write to stdout: {0}")]
struct Unwritten(std::io::Error);

/// Writes text to stdout. A closed pipe is taken as "enough".
pub fn write(text: &str) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Writes a result to stdout.
pub fn print(text: &str) -> Result<(), Failure> {
    write(text).map_err(|error| Failure::of(Unwritten(error)))
}

/// Prints a line to stderr, if anybody is there.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
