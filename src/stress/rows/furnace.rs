//! Closed boxes whose walls all glow.

use glam::UVec2;

use crate::layout::trace::{SAMPLE_BAD, TraceParams};
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::boxes::{furnace, inside};
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "furnace",
    holds: "within glowing walls every sample is Le (1 - rho^D) / (1 - rho), D segments long",
    quantity: "relative error of a sample",
    most: 1e-5,
    unit: "samples",
    sizes: [7_000, 100_000, 10_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let cases = [(0.5f32, 1), (0.5, 2), (0.7, 8), (0.9, 16), (1.0, 24), (0.99, 200)];
    let side = 24;
    let layers = size.div_ceil(cases.len() as u64 * u64::from(side * side)).min(4096) as u32;
    let mut rig = lab.rig();
    let mut all = Measured::new(0.0, 0);
    for (k, (albedo, depth)) in cases.into_iter().enumerate() {
        let room = furnace(albedo, 3.0);
        room.load(&mut rig)?;
        let params = TraceParams { layers, ..inside(&room, UVec2::splat(side), depth) };
        let rho = f64::from(albedo);
        let right = 3.0 * (0..depth).map(|i| rho.powi(i as i32)).sum::<f64>();
        let got = samples(&mut rig, &params)?;
        if let Some(bad) = got.iter().find(|sample| sample.info & SAMPLE_BAD != 0) {
            return Err(StressError::Broken(format!("a bad sample: {bad:?}")));
        }
        if let Some(short) = got.iter().find(|sample| sample.info != depth) {
            return Err(StressError::Broken(format!("a path left the box: {short:?}")));
        }
        let off = |rgb: glam::Vec3| greatest((rgb.as_dvec3() / right - 1.0).abs().to_array());
        let worst = greatest(got.iter().map(|sample| off(sample.rgb)));
        let note = format!("albedo {albedo}, {depth} segments");
        all = all.worst(Measured::new(worst, got.len() as u64).noted(note));
        lab.tell(k as u64 + 1, cases.len() as u64);
    }
    Ok(all)
}
