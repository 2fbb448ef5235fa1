//! Paths that are reused within tiles, against paths that are not, on other random numbers.

use glam::UVec2;

use crate::cpu::rng::Source;
use crate::layout::trace::TraceParams;
use crate::stats::agreement::{BATCHES, MOST_ERRORS};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::{as_measured, compare, kernel, paths_of, reusing};

pub static ROW: Row = Row {
    name: "reuse",
    holds: "paths that pixels reuse have the mean of paths of their own",
    quantity: "standard errors between the two",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [6_600_000, 6_600_000, 200_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let asked = |room: Room| Room { next_event: true, roulette: true, sampler: Source::Sobol, ..room };
    let rooms = [
        ("a room", asked(Room::cornell())),
        ("a room, independent numbers", Room { sampler: Source::Pcg, roulette: false, ..asked(Room::cornell()) }),
        ("lights are hit", Room { next_event: false, ..asked(Room::cornell()) }),
        ("glass", asked(Room::glass())),
    ];
    let mut all = Measured::new(0.0, 0);
    for (k, (name, room)) in rooms.iter().enumerate() {
        // One block, whose pixels see all of the room: 820,000 paths each at least.
        let layers = size.div_ceil((2 * rooms.len() * BATCHES * 64) as u64).max(400) as u32;
        let params = TraceParams { layers, seed: 1, ..room.params(UVec2::splat(8)) };
        let own = TraceParams { seed: 2, ..params };
        let agreement = compare(
            reusing(lab.gpu(), lab.library().clone(), room, &params)?,
            kernel(lab.gpu(), lab.library().clone(), room, &own)?,
        )?;
        all = all.worst(as_measured(agreement, 2 * paths_of(&params), name));
        lab.tell(k as u64 + 1, rooms.len() as u64);
    }
    Ok(all)
}
