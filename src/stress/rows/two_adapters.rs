//! One kernel, one seed, on this adapter and on every other that the machine has.

use glam::{DVec3, UVec2};

use crate::gpu::{Gpu, Runtime, adapters};
use crate::layout::trace::TraceParams;
use crate::stats::metrics::relative_mse;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "two-adapters",
    holds: "a Cornell box of 16 samples a pixel is the same picture on every adapter of the machine",
    quantity: "relMSE between two adapters",
    most: 1e-6,
    unit: "samples",
    sizes: [64 * 64 * SPP as u64, SIDE * SIDE * SPP as u64, SIDE * SIDE * SPP as u64],
    measure,
};

/// Samples a pixel, and pixels a side.
const SPP: u32 = 16;
const SIDE: u64 = 256;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let side = (size / u64::from(SPP)).isqrt() as u32;
    let own = picture(&mut lab.rig(), side)?;
    let others: Vec<(usize, String)> = adapters()
        .into_iter()
        .enumerate()
        .filter(|(_, adapter)| !adapter.chosen)
        .map(|(number, adapter)| (number, format!("{} ({})", adapter.name, adapter.backend)))
        .collect();
    if others.is_empty() {
        let doubt = Some("this machine has one adapter".to_owned());
        return Ok(Measured { doubt, ..Measured::new(0.0, size) });
    }
    let mut all = Measured::new(0.0, 0);
    for (k, (number, name)) in others.iter().enumerate() {
        lab.tell(k as u64, others.len() as u64);
        let mut rig = Runtime::new(Gpu::open_number(*number)?, lab.library().clone());
        let off = relative_mse(&picture(&mut rig, side)?, &own);
        all = all.worst(Measured::new(off, size).noted(format!("{} and {name}", lab.gpu().name())));
    }
    Ok(all)
}

/// The means of all pixels of a picture of so many pixels a side. The kernel is the one for that device.
pub fn picture(rig: &mut Runtime, side: u32) -> Result<Vec<[f64; 3]>, StressError> {
    let room = Room { next_event: true, ..Room::cornell() };
    room.load(rig)?;
    let features = [&room.features()[..], rig.gpu().shader_features()].concat();
    rig.set_features(&features);
    let params = TraceParams { layers: SPP, ..room.params(UVec2::splat(side)) };
    let got = samples(rig, &params)?;
    let pixels = (side * side) as usize;
    let mean = |at: usize| got[at..].iter().step_by(pixels).map(|s| s.rgb.as_dvec3()).sum::<DVec3>() / f64::from(SPP);
    Ok((0..pixels).map(|at| mean(at).to_array()).collect())
}
