//! Covers close below a lamp.

use glam::Vec3;

use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::covered::{Covered, PLAIN};
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "covers",
    holds: "an opaque cover 1e-6 to 1e-3 of the way below a lamp hides it, at scales of 1e-6 to 1e6 and off the origin",
    quantity: "part of the light that comes through",
    most: 0.0,
    unit: "samples",
    sizes: [14 * 4_096, 14 * 65_536, 14 * 4_000_000],
    measure,
};

/// The mean radiance that light sampling finds.
fn sampled(lab: &Lab, stage: &Covered, layers: u32) -> Result<f64, StressError> {
    let room = Room { next_event: true, ..stage.room() };
    let mut rig = lab.rig();
    room.load(&mut rig)?;
    let got = samples(&mut rig, &stage.params(&room, layers))?;
    Ok(got.iter().map(|sample| sample.rgb.as_dvec3().element_sum()).sum::<f64>() / got.len() as f64)
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let lamps = vec![Vec3::splat(5.0)];
    let mut stages = Vec::new();
    for scale in [1.0, 1e-6, 1e6] {
        // Floats tell heights near 1 apart by 6e-8, and t by a few of that: from 1e-6 on, every cover is before its lamp.
        for gap in [1e-6, 1e-5, 1e-4, 1e-3] {
            stages.push(Covered { lamps: lamps.clone(), gap: Some(gap), scale, ..PLAIN });
        }
    }
    // Far from the origin floats are coarser.
    let offset = Vec3::new(100.0, -50.0, 70.0);
    stages.push(Covered { lamps: lamps.clone(), gap: Some(1e-3), offset, ..PLAIN });
    let layers = size.div_ceil(64 * (stages.len() as u64 + 1)).min(1 << 16) as u32;
    let open = sampled(lab, &Covered { lamps: lamps.clone(), ..PLAIN }, layers)?;
    let above = sampled(lab, &Covered { lamps, gap: Some(-1e-5), ..PLAIN }, layers)?;
    if (above / open - 1.0).abs() > 1e-6 {
        return Err(StressError::Broken(format!("a cover above the lamp makes {above} of {open}")));
    }
    let mut all = Measured::new(0.0, u64::from(layers) * 64);
    for (k, stage) in stages.iter().enumerate() {
        let through = sampled(lab, stage, layers)? / open;
        let note = format!("gap {:e}, scale {:e}", stage.gap.unwrap_or_default(), stage.scale);
        all = all.worst(Measured::new(through, u64::from(layers) * 64).noted(note));
        lab.tell(k as u64 + 1, stages.len() as u64);
    }
    Ok(all)
}
