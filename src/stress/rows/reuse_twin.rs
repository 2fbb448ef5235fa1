//! Paths that are reused within tiles, against the f64 twin on the same random numbers.

use glam::UVec2;

use crate::layout::trace::TraceParams;
use crate::stats::agreement::MOST_ERRORS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::{as_measured, compare, paths_of, reusing, twin_reusing};

pub static ROW: Row = Row {
    name: "reuse-twin",
    holds: "reused paths find what their f64 twin finds on the same random numbers",
    quantity: "standard errors between kernels and f64 twin",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [74_000, 150_000, 500_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let asked = |room: Room| Room { next_event: true, ..room };
    let mut rooms = vec![("a room", asked(Room::cornell()))];
    if lab.scale() != Scale::Test {
        rooms.push(("glass", asked(Room::glass())));
    }
    let mut all = Measured::new(0.0, 0);
    for (k, (name, room)) in rooms.iter().enumerate() {
        let layers = size.div_ceil(rooms.len() as u64 * 24 * 24 * 32) as u32;
        let params = TraceParams { layers, ..room.params(UVec2::splat(24)) };
        let twin = twin_reusing(room, &params);
        let agreement = compare(reusing(lab.gpu(), lab.library().clone(), room, &params)?, |i| Ok(twin(i)))?;
        all = all.worst(as_measured(agreement, paths_of(&params), name));
        lab.tell(k as u64 + 1, rooms.len() as u64);
    }
    Ok(all)
}
