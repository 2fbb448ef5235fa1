//! The kernel against its f64 twin on the same random numbers, path by path.

use glam::UVec2;

use crate::cpu::rng::Source;
use crate::layout::trace::TraceParams;
use crate::stats::agreement::MOST_ERRORS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::{against_twin, as_measured, paths_of};

pub static ROW: Row = Row {
    name: "twin",
    holds: "single precision on the device finds what double precision finds on the same random numbers",
    quantity: "standard errors between kernel and f64 twin",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [148_000, 300_000, 1_500_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let asked = |room: Room| Room { next_event: true, ..room };
    let mut rooms = vec![("a room, lights are sampled", asked(Room::cornell())), ("a room", Room::cornell())];
    if lab.scale() != Scale::Test {
        let sobol = |room: Room| Room { sampler: Source::Sobol, roulette: true, ..room };
        rooms.extend([("glass", Room::glass()), ("glass, Sobol, roulette", sobol(asked(Room::glass())))]);
    }
    let mut all = Measured::new(0.0, 0);
    for (k, (name, room)) in rooms.iter().enumerate() {
        // 24 x 24 pixels of 32 batches.
        let layers = size.div_ceil(rooms.len() as u64 * 24 * 24 * 32) as u32;
        let params = TraceParams { layers, ..room.params(UVec2::splat(24)) };
        let agreement = against_twin(lab.gpu(), lab.library().clone(), room, &params)?;
        all = all.worst(as_measured(agreement, paths_of(&params), name));
        lab.tell(k as u64 + 1, rooms.len() as u64);
    }
    Ok(all)
}
