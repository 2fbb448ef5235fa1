//! What a measurement says of its row.

use std::time::Instant;

use super::lab::Lab;
use super::measured::{Measured, StressError};
use super::row::Row;

/// Whether what must hold does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    Holds,
    /// And what it is, where there is no figure.
    Fails(Option<String>),
    /// And why.
    CannotTell(String),
}

/// A row, and what came of it.
#[derive(Debug)]
pub struct Outcome {
    pub row: &'static Row,
    pub measured: Result<Measured, StressError>,
    /// What it took, compiling included.
    pub seconds: f64,
}

/// Measures a row.
pub fn judge(row: &'static Row, lab: &Lab) -> Outcome {
    let begin = Instant::now();
    let measured = (row.measure)(lab, row.size(lab.scale()));
    Outcome { row, measured, seconds: begin.elapsed().as_secs_f64() }
}

impl Outcome {
    pub fn verdict(&self) -> Verdict {
        match &self.measured {
            Err(error) if error.is_of_machine() => Verdict::CannotTell(error.to_string()),
            Err(error) => Verdict::Fails(Some(error.to_string())),
            // What is far beyond is seen through any noise.
            Ok(measured) => match (&measured.doubt, measured.value <= self.row.most) {
                (None, true) => Verdict::Holds,
                (Some(doubt), true) => Verdict::CannotTell(doubt.clone()),
                (_, false) => Verdict::Fails(None),
            },
        }
    }

    /// How many times what was measured would fit in what it may be: above 1 where the row holds. None without a figure, and where nothing
    /// at all is allowed.
    pub fn margin(&self) -> Option<f64> {
        let value = self.measured.as_ref().ok()?.value;
        (self.row.most > 0.0).then(|| self.row.most / value)
    }
}
