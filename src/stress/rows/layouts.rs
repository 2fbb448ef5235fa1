//! One picture by every layout of the kernel: few triangles or a walk, and that of a GPU or of a processor.

use glam::{DVec3, UVec2};

use crate::layout::trace::TraceParams;
use crate::stats::metrics::relative_mse;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "layouts",
    holds: "the kernel that walks as on a GPU, as on a processor, or over few triangles makes one picture of one seed",
    quantity: "relMSE between two layouts",
    most: 1e-6,
    unit: "samples",
    sizes: [200_000, 2_000_000, 8_000_000],
    measure,
};

/// Samples a pixel.
const SPP: u32 = 16;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    // Without its ball the room has few triangles.
    let mut bare = Room { next_event: true, ..Room::cornell() };
    bare.triangles.truncate(22);
    bare.shading.clear();
    let rooms =
        [("a room", Room { next_event: true, ..Room::cornell() }), ("few triangles", bare), ("glass", Room::glass())];
    let side = ((size / (rooms.len() as u64 * 3 * u64::from(SPP))) as f64).sqrt().clamp(32.0, 256.0) as u32;
    let mut rig = lab.rig();
    let mut all = Measured::new(0.0, 0);
    for (k, (name, room)) in rooms.iter().enumerate() {
        room.load(&mut rig)?;
        let params = TraceParams { layers: SPP, ..room.params(UVec2::splat(side)) };
        let own = room.features();
        let walks: Vec<&str> = own.iter().copied().filter(|feature| *feature != "few_triangles").collect();
        let on_processor = [&walks[..], &["software"]].concat();
        let mut pictures = Vec::new();
        for features in [&own, &walks, &on_processor] {
            rig.set_features(features);
            let got = samples(&mut rig, &params)?;
            let pixels = (side * side) as usize;
            let mean =
                |at: usize| got[at..].iter().step_by(pixels).map(|s| s.rgb.as_dvec3()).sum::<DVec3>() / f64::from(SPP);
            pictures.push((0..pixels).map(|at| mean(at).to_array()).collect::<Vec<[f64; 3]>>());
        }
        for (other, which) in pictures[1..].iter().zip(["a GPU's walk", "a processor's walk"]) {
            let off = relative_mse(other, &pictures[0]);
            all = all.worst(Measured::new(off, u64::from(side * side * SPP)).noted(format!("{name}, {which}")));
        }
        lab.tell(k as u64 + 1, rooms.len() as u64);
    }
    Ok(all)
}
