//! Triangles a million times as long as high, and some of no area among them.

use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::solids::{degenerate, slivers};
use crate::stress::tools::aimed::{Aimed, aim};

pub static ROW: Row = Row {
    name: "slivers",
    holds: "a closed mesh of triangles of aspect 1e6 has no cracks, and triangles without area are never hit",
    quantity: "rays that miss, or hit what has no area",
    most: 0.0,
    unit: "rays",
    sizes: [200_000, 2_000_000, 100_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut all = Measured::new(0.0, 0);
    for (k, columns) in [6, 7].into_iter().enumerate() {
        let mut triangles = slivers(columns);
        let sound = triangles.len();
        // A power of two, so that what is without area stays without.
        triangles.extend(degenerate(60).iter().map(|corners| corners.map(|v| v / 32.0)));
        let part = size / 2;
        let found = aim(lab, &triangles, sound, part, |done| lab.tell(k as u64 * part + done, size))?;
        let Aimed { rays, missed, degenerate } = found;
        all = all.plus(Measured::new((missed + degenerate) as f64, rays));
    }
    Ok(all)
}
