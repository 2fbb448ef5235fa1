//! A row of the table: what must hold, and how it is measured.

use super::lab::Lab;
use super::measured::{Measured, Scale, StressError};

/// What must hold, and how it is measured.
#[derive(Debug)]
pub struct Row {
    /// What it is called by.
    pub name: &'static str,
    /// What must hold, in a sentence.
    pub holds: &'static str,
    /// What is measured: `rays that miss`.
    pub quantity: &'static str,
    /// What that may be at most.
    pub most: f64,
    /// What is counted as samples: `rays`.
    pub unit: &'static str,
    /// Samples, about, by [`Scale`].
    pub sizes: [u64; 3],
    /// Measures so many samples.
    pub measure: fn(&Lab, u64) -> Result<Measured, StressError>,
}

impl Row {
    /// Samples at a scale.
    pub fn size(&self, scale: Scale) -> u64 {
        self.sizes[scale as usize]
    }
}
