//! What was rendered: of a film that was traced in one band, its pixels; of one in several, what they come to, for the pixels are in files by then.

use std::time::Duration;

use glam::UVec2;

use super::until::Ended;
use crate::components::Crop;
use crate::engine::{ErrorSums, FilmError, FilmPart, FilmSum, Report};

/// A band that was traced.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    pub window: Crop,
    /// Samples that every pixel of it has.
    pub spp: u32,
    pub ended: Ended,
    pub error: ErrorSums,
}

/// A film, as far as it was traced.
#[derive(Clone, Debug)]
pub struct FilmSummary {
    /// The whole film, pixels.
    pub size: UVec2,
    /// The part of it that was to be rendered.
    pub window: Crop,
    /// In the order of their rows.
    pub bands: Vec<Band>,
    sum: FilmSum,
}

impl FilmSummary {
    /// Nothing was traced yet.
    pub fn new(size: UVec2, window: Crop) -> Self {
        Self { size, window, bands: Vec::new(), sum: FilmSum::default() }
    }

    /// Adds the band below the last one.
    pub fn add(&mut self, part: &FilmPart, ended: Ended) {
        self.bands.push(Band { window: part.window, spp: part.spp, ended, error: part.error });
        self.sum = self.sum.and(part.sum);
    }

    /// The row below the last band.
    pub fn end(&self) -> u32 {
        self.bands.last().map_or(self.window.min.y, |band| band.window.max.y)
    }

    /// Samples that every pixel has.
    pub fn spp(&self) -> u32 {
        self.samples()[0]
    }

    /// The least samples that a pixel has, and those that every pixel of some band has.
    pub fn samples(&self) -> [u32; 2] {
        let samples = || self.bands.iter().map(|band| band.spp);
        let least = if self.end() < self.window.max.y { None } else { samples().min() };
        [least, samples().max()].map(|spp| spp.unwrap_or(0))
    }

    /// Whether it was traced in parts.
    pub fn is_in_bands(&self) -> bool {
        self.bands.iter().any(|band| band.window != self.window)
    }

    /// Mean over all pixels that have samples.
    pub fn mean(&self) -> [f64; 3] {
        self.sum.mean()
    }

    /// What the film tells of its error; with one sample a pixel, nothing.
    pub fn error(&self) -> Option<FilmError> {
        let sums = self.bands.iter().map(|band| band.error);
        (self.spp() > 1).then(|| sums.fold(ErrorSums::default(), ErrorSums::and).error())
    }

    /// How tracing ended: as the band that is worst off. Only an interrupt leaves rows that were not traced.
    pub fn ended(&self) -> Ended {
        let bands = self.bands.iter().map(|band| band.ended).max();
        bands.filter(|_| self.end() == self.window.max.y).unwrap_or(Ended::Interrupted)
    }
}

/// All that tracing came to.
#[derive(Debug)]
pub struct Rendered {
    pub film: FilmSummary,
    /// The pixels, of a film that was traced at once.
    pub whole: Option<FilmPart>,
    /// What the engine did; none where nothing was traced.
    pub report: Option<Report>,
    /// Spent on reading the film's error, to see whether it is good enough, and to show it.
    pub looking: Duration,
    /// Spent on reading finished bands back.
    pub reading: Duration,
}
