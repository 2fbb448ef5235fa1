//! Whole scenes far from the origin of their coordinates.

use glam::{DAffine3, DVec3};

use crate::stats::agreement::MOST_ERRORS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::placed::agree_where_placed;

pub static ROW: Row = Row {
    name: "moved-pictures",
    holds: "a scene and its camera moved by 1e4 or 1e6 units give the same picture",
    quantity: "standard errors from the unmoved picture",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [800_000, 1_000_000, 400_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let places = [1e4, 1e6]
        .map(|far| (format!("moved by {far:e}"), DAffine3::from_translation(DVec3::new(far, -0.37 * far, 0.71 * far))));
    agree_where_placed(lab, &places, size)
}
