//! Gaps that floats can't resolve: which of the two a ray meets first is rounding's to say, and says the same to both estimators.

use glam::Vec3;

use crate::layout::trace::TraceParams;
use crate::stats::agreement::{BATCHES, MOST_ERRORS};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::covered::{Covered, PLAIN};
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::{as_measured, compare, kernel, paths_of};

pub static ROW: Row = Row {
    name: "coincident-lamps",
    holds: "covers within rounding of a lamp, one to three lamps in one place, a lamp in its ceiling: integrators agree",
    quantity: "standard errors between path and bsdf",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [39_000_000, 39_000_000, 400_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let (red, green, blue) = (Vec3::new(5.0, 0.5, 0.5), Vec3::new(0.5, 5.0, 0.5), Vec3::new(0.5, 0.5, 5.0));
    let stages = [
        Covered { lamps: vec![red], gap: Some(0.0), ..PLAIN },
        Covered { lamps: vec![red], gap: Some(f32::EPSILON / 2.0), ..PLAIN },
        Covered { lamps: vec![red], gap: Some(1e-7), one_sided: true, ..PLAIN },
        Covered { lamps: vec![red, green], ..PLAIN },
        Covered { lamps: vec![red, green, blue], one_sided: true, ..PLAIN },
        // A lamp in the plane of its ceiling.
        Covered { lamps: vec![red, red], gap: Some(0.0), scale: 1e-3, ..PLAIN },
    ];
    let layers = size.div_ceil((stages.len() * BATCHES * 64) as u64).max(3200) as u32;
    let mut all = Measured::new(0.0, 0);
    for (case, stage) in stages.iter().enumerate() {
        let room = stage.room();
        let params = stage.params(&room, layers);
        let sampling = Room { next_event: true, ..room.clone() };
        let sampled = TraceParams { seed: 2, ..stage.params(&sampling, layers) };
        let agreement = compare(
            kernel(lab.gpu(), lab.library().clone(), &sampling, &sampled)?,
            kernel(lab.gpu(), lab.library().clone(), &room, &params)?,
        )?;
        all = all.worst(as_measured(agreement, paths_of(&params), &format!("case {case}")));
        lab.tell(case as u64 + 1, stages.len() as u64);
    }
    Ok(all)
}
