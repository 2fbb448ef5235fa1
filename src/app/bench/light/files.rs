//! The files that a benchmark leaves in its folder.

use std::path::Path;

use super::plot::{self, Axis};
use super::record::Bench;
use crate::app::bench::BenchError;
use crate::app::shared::failure::show;
use crate::image::file;

/// Tries whether files can be written: what is measured for an hour is not to end in a refusal.
pub fn prepare(folder: &Path, names: &[&str]) -> Result<(), BenchError> {
    Ok(names.iter().try_for_each(|name| file::prepare(&folder.join(name)).map(drop))?)
}

/// Writes texts by their names, and the plots of all scenes. Says which were written, a line each, and whether all were.
pub fn write(folder: &Path, names: &[&str], texts: &[&str], bench: &Bench) -> (String, bool) {
    let mut files: Vec<(String, String)> =
        names.iter().zip(texts).map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
    for scene in &bench.scenes {
        for axis in [Axis::Seconds, Axis::Samples] {
            files.extend(plot::svg(bench, scene, axis).map(|svg| (plot::file_name(scene, axis), svg)));
        }
    }
    let (mut written, mut whole) = (String::new(), true);
    for (name, text) in &files {
        let path = folder.join(name);
        match file::write_text(&path, text) {
            Ok(()) => written += &format!("{}\n", path.display()),
            Err(failure) => {
                show(&BenchError::from(failure));
                whole = false;
            }
        }
    }
    (written, whole)
}
