//! One scene in several places.

use glam::{DAffine3, UVec2};

use super::films::{film_of_seed, film_sums};
use super::paths::{Sums, as_measured, compare};
use crate::stats::agreement::BATCHES;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::scenes::described::{Inside, room};

const SIDE: u32 = 16;

/// Whether a room looks alike wherever it is, by so many paths of equal random numbers in each place.
pub fn agree_where_placed(lab: &Lab, places: &[(String, DAffine3)], size: u64) -> Result<Measured, StressError> {
    let films = (places.len() + 1) as u64 * BATCHES as u64;
    let spp = size.div_ceil(films * u64::from(SIDE * SIDE)).max(1) as u32;
    let mut done = 0;
    let mut sums = |place: DAffine3| -> Result<Vec<Sums>, StressError> {
        let mut description = room(UVec2::splat(SIDE), Inside::Rough, place);
        description.render.spp = spp;
        let mut engine = lab.engine(&description)?;
        let mut all = Vec::new();
        for seed in 0..BATCHES as u32 {
            all.push(film_sums(&film_of_seed(&mut engine, seed)?));
            done += 1;
            lab.tell(done, films);
        }
        Ok(all)
    };
    let right = sums(DAffine3::IDENTITY)?;
    let mut all = Measured::new(0.0, 0);
    for (name, place) in places {
        let moved = sums(*place)?;
        let agreement = compare(|i| Ok(moved[i].clone()), |i| Ok(right[i].clone()))?;
        // Their numbers are equal, so that the noise is of what differs alone.
        let paths = u64::from(spp * SIDE * SIDE) * BATCHES as u64;
        let mut measured = as_measured(agreement, paths, name);
        measured.note = format!("{name}: off by {:.1e} of the mean", (agreement.difference / agreement.mean).abs());
        all = all.worst(measured);
    }
    Ok(all)
}
