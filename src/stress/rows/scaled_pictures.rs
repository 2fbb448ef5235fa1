//! Whole scenes of another size.

use glam::{DAffine3, DVec3};

use crate::stats::agreement::MOST_ERRORS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::placed::agree_where_placed;

pub static ROW: Row = Row {
    name: "scaled-pictures",
    holds: "a scene and its camera scaled by 1e-6 or 1e6 give the same picture",
    quantity: "standard errors from the unscaled picture",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [800_000, 1_000_000, 400_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let places = [1e-6, 1e6].map(|by| (format!("scaled by {by:e}"), DAffine3::from_scale(DVec3::splat(by))));
    agree_where_placed(lab, &places, size)
}
