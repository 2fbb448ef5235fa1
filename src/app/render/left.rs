//! What a report says of bands, and of what an interrupt left of them.

use std::path::Path;

use serde_json::{Value, json};

use super::rendered::Band;
use super::report::RenderSummary;
use super::until::Ended;
use crate::components::Crop;
use crate::image::Outputs;

impl RenderSummary<'_> {
    /// Of each band, its rows and what they have.
    pub fn bands(&self) -> Option<Vec<Value>> {
        let told = |band: &Band| {
            let error = (band.spp > 1).then(|| band.error.error());
            json!({
                "rows": [band.window.min.y, band.window.max.y],
                "spp": band.spp,
                "ended_by": band.ended.word(),
                "relative_error": error.map(|error| error.relmse),
                "relative_error_bound": error.map(|error| error.bound),
            })
        };
        self.film.is_in_bands().then(|| self.film.bands.iter().map(told).collect())
    }

    /// A command line that renders, to files of their own, the rows that an interrupt left black, with those of the band that it cut short.
    pub fn rest(&self, outputs: &Outputs) -> Option<String> {
        let film = self.film;
        if !film.is_in_bands() || film.ended() != Ended::Interrupted {
            return None;
        }
        let cut = film.bands.last().filter(|band| band.ended == Ended::Interrupted);
        let first = cut.map_or(film.end(), |band| band.window.min.y);
        let files: Vec<String> = outputs.names().iter().map(|name| beside(name, first)).collect();
        let window = Crop { min: film.window.min.with_y(first), max: film.window.max };
        Some(self.described().part(window, self.until.flags(), &files))
    }

    /// What an interrupt left; nothing without one.
    pub fn interrupted_lines(&self, outputs: &Outputs) -> Vec<String> {
        let film = self.film;
        let of = self.until.spp.map_or(String::new(), |spp| format!(" of {spp}"));
        match (film.ended(), self.rest(outputs)) {
            (Ended::Interrupted, None) => vec![format!("interrupted at {}{of} spp", film.spp())],
            (Ended::Interrupted, Some(rest)) => vec![
                format!(
                    "interrupted in row {} of {}: those below are black; this renders the rest:",
                    film.end(),
                    film.size.y
                ),
                format!("  {rest}"),
            ],
            _ => Vec::new(),
        }
    }
}

/// The name of a file beside another one, for the rows from `first` on.
fn beside(name: &str, first: u32) -> String {
    let path = Path::new(name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map_or(String::new(), |ending| format!(".{}", ending.to_string_lossy()));
    path.with_file_name(format!("{stem}-rows-{first}{ending}")).display().to_string()
}
