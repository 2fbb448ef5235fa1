//! Several files of one picture: one that can't be written keeps none of the others from being written.

use std::path::PathBuf;
use std::time::Instant;

use super::file::{self, SaveError};
use super::source::{Frame, Metadata};
use super::strips::Strips;
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

    /// Whether all of them are pictures.
    pub fn are_pictures(&self) -> bool {
        self.files.iter().all(|file| file.kind != Kind::Json)
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
        let pictures: Vec<&Output> = self.files.iter().filter(|file| file.kind != Kind::Json).collect();
        let write = |number: usize| {
            let begin = Instant::now();
            pictures[number].write(picture).map(|()| begin.elapsed().as_secs_f64())
        };
        let written = parallel::map(pictures.len(), write);
        let endings = pictures.into_iter().cloned().zip(written).collect();
        self.end(endings, report)
    }

    /// Begins to write pictures whose rows come strip by strip. `most`: bytes that their metadata take at most, as JSON.
    pub fn begin(&self, frame: Frame, most: usize) -> Strips {
        Strips::begin(&self.files, frame, most)
    }

    /// Ends what was begun, as [`write`](Self::write) ends: keeps the files that were written, and writes the report.
    pub fn finish(
        &mut self,
        strips: Strips,
        metadata: &Metadata,
        report: impl FnOnce(&Self) -> serde_json::Value,
    ) -> Vec<SaveError> {
        self.end(strips.finish(metadata), report)
    }

    /// Drops the pictures that could not be written, then writes the report.
    fn end(
        &mut self,
        endings: Vec<(Output, Result<f64, SaveError>)>,
        report: impl FnOnce(&Self) -> serde_json::Value,
    ) -> Vec<SaveError> {
        let mut failures = Vec::new();
        let place = |file: &Output| self.files.iter().position(|known| known == file);
        let mut endings: Vec<_> = endings.into_iter().map(|(file, ending)| (place(&file), file, ending)).collect();
        endings.sort_by_key(|(place, ..)| *place);
        for (_, file, ending) in endings {
            match ending {
                Ok(seconds) => self.seconds.push((name(&file), seconds)),
                Err(failure) => {
                    self.files.retain(|known| *known != file);
                    failures.push(failure);
                }
            }
        }
        let report = report(self);
        self.files.retain(|output| {
            output.kind != Kind::Json || output.write_report(&report).map_err(|failure| failures.push(failure)).is_ok()
        });
        failures
    }
}

fn name(output: &Output) -> String {
    output.path.display().to_string()
}
