//! Lamps of a millionth of the scene's size, some of them grazing.

use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::lamp::tiny_lamps;
use crate::stress::tools::lamps::seen;

pub static ROW: Row = Row {
    name: "tiny-lights",
    holds: "a lamp of 1e-6 of the scene's size, grazing or not, gives its analytic irradiance",
    quantity: "relative error",
    most: 1e-3,
    unit: "samples",
    sizes: [25_000, 400_000, 40_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let lamps = tiny_lamps();
    let layers = size.div_ceil(lamps.len() as u64 * 256).min(1 << 15) as u32;
    let mut all = Measured::new(0.0, 0);
    for (case, lamp) in lamps.iter().enumerate() {
        let room = lamp.room();
        let (mean, error) = seen(lab, &room, layers, 2)?;
        let right = lamp.reflected(&room);
        let mut measured = Measured::new((mean / right - 1.0).abs(), u64::from(layers) * 256);
        measured.note = format!("case {case}");
        if error > 1e-4 * right {
            measured.doubt = Some(format!("case {case}: a standard error of {error:e} proves nothing of {right:e}"));
        }
        all = all.worst(measured);
        lab.tell(case as u64 + 1, lamps.len() as u64);
    }
    Ok(all)
}
