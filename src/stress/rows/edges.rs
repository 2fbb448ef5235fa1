//! Closed meshes have no cracks.

use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::solids::sphere;
use crate::stress::tools::aimed::{Aimed, aim};

pub static ROW: Row = Row {
    name: "edges",
    holds: "a ray from inside a closed mesh at a point of an edge, or at a corner, hits the mesh",
    quantity: "rays that miss",
    most: 0.0,
    unit: "rays",
    sizes: [300_000, 10_000_000, 1_000_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut all = Measured::new(0.0, 0);
    for (k, level) in [1, 3, 5].into_iter().enumerate() {
        let triangles = sphere(level);
        let part = size / 3;
        let Aimed { rays, missed, .. } =
            aim(lab, &triangles, triangles.len(), part, |done| lab.tell(k as u64 * part + done, size))?;
        all = all.plus(Measured::new(missed as f64, rays).noted(format!("{} triangles", triangles.len())));
    }
    Ok(all.noted("half of them at corners"))
}
