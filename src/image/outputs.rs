//! Several files of one picture: one that can't be written keeps none of the others from being written.

use std::path::PathBuf;

use super::file::{self, SaveError};
use super::write::{Kind, Output, Picture};

/// The files to be written, each once.
#[derive(Debug, Default)]
pub struct Outputs {
    files: Vec<Output>,
}

impl Outputs {
    /// Tries whether files can be written at their places, without loss of those that are `read`. Those that can't are left out and
    /// returned; a file that several names lead to is written once.
    pub fn prepare(outputs: &[Output], read: &[PathBuf]) -> (Self, Vec<SaveError>) {
        let mut places: Vec<(PathBuf, &Output)> = Vec::new();
        let mut failures = Vec::new();
        for output in outputs {
            match file::prepare(&output.path) {
                Err(failure) => failures.push(failure),
                Ok(place) if file::is_among(&place, read) => failures.push(SaveError::Input(output.path.clone())),
                Ok(place) => match places.iter().find(|(taken, _)| *taken == place) {
                    None => places.push((place, output)),
                    Some((_, first)) if first.kind == output.kind => {}
                    Some((_, first)) => failures.push(SaveError::Same(first.path.clone(), output.path.clone())),
                },
            }
        }
        (Self { files: places.into_iter().map(|(_, output)| output.clone()).collect() }, failures)
    }

    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The names of the files, as the user gave them.
    pub fn names(&self) -> Vec<String> {
        self.files.iter().map(|output| output.path.display().to_string()).collect()
    }

    /// Writes all that can be written, and keeps those that were. The report, which `report` makes of their names, comes last:
    /// it names no file that could not be written before it.
    pub fn write(&mut self, picture: &Picture, report: impl FnOnce(&[String]) -> serde_json::Value) -> Vec<SaveError> {
        let mut failures = Vec::new();
        let mut keep = |result: Result<(), SaveError>| result.map_err(|failure| failures.push(failure)).is_ok();
        self.files.retain(|output| output.kind == Kind::Json || keep(output.write(picture)));
        let report = report(&self.names());
        let picture = Picture { report: &report, ..*picture };
        self.files.retain(|output| output.kind != Kind::Json || keep(output.write(&picture)));
        failures
    }
}
