//! Results go to stdout, and a reader that has gone is no error.

use std::io::{ErrorKind, Write};
use std::path::Path;

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

/// Writes a file whole, under a temporary name beside its place that is then renamed, and makes the folders it lacks.
pub fn write_file(path: &Path, text: &str) -> std::io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lucerna-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(text.as_bytes())?;
    file.as_file().sync_data()?;
    file.persist(path).map_err(|failed| failed.error)?;
    Ok(())
}
