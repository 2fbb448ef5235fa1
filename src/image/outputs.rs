//! Several files of one picture: one that can't be written keeps none of the others from being written.

use std::path::PathBuf;
use std::time::Instant;

use super::file::{self, SaveError};
use super::write::{Kind, Output, Picture};
use crate::parallel;

/// The files to be written, each once.
#[derive(Debug, Default)]
pub struct Outputs {
    files: Vec<Output>,
    /// What writing each picture took, by the name of its file.
    seconds: Vec<(String, f64)>,
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
        (Self { files: places.into_iter().map(|(_, output)| output.clone()).collect(), seconds: Vec::new() }, failures)
    }

    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The names of the files, as the user gave them.
    pub fn names(&self) -> Vec<String> {
        self.files.iter().map(name).collect()
    }

    /// Names of the pictures that were written, and the seconds that each took; they are written at the same time.
    pub fn seconds(&self) -> &[(String, f64)] {
        &self.seconds
    }

    /// Writes all that can be written, and keeps those that were. The report, which `report` makes of them, comes last:
    /// it names no file that could not be written before it.
    pub fn write(&mut self, picture: &Picture, report: impl FnOnce(&Self) -> serde_json::Value) -> Vec<SaveError> {
        let mut failures = Vec::new();
        let (reports, pictures): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.files).into_iter().enumerate().partition(|(_, file)| file.kind == Kind::Json);
        let write = |number: usize| {
            let begin = Instant::now();
            (pictures[number].1.write(picture), begin.elapsed().as_secs_f64())
        };
        let mut kept = Vec::new();
        for ((place, file), (result, seconds)) in pictures.iter().zip(parallel::map(pictures.len(), write)) {
            match result {
                Ok(()) => {
                    self.seconds.push((name(file), seconds));
                    kept.push((*place, file.clone()));
                }
                Err(failure) => failures.push(failure),
            }
        }
        kept.extend(reports.iter().cloned());
        kept.sort_by_key(|(place, _)| *place);
        self.files = kept.into_iter().map(|(_, file)| file).collect();
        let report = report(self);
        let picture = Picture { report: &report, ..*picture };
        self.files.retain(|output| {
            output.kind != Kind::Json || output.write(&picture).map_err(|failure| failures.push(failure)).is_ok()
        });
        failures
    }
}

fn name(output: &Output) -> String {
    output.path.display().to_string()
}
