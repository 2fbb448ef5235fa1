//! White furnaces: what lobes reflect in all.

use glam::DVec3;

use crate::cpu::bsdf::Specular::{self, Ggx, Phong};
use crate::gpu::{GpuError, Runtime};
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::quadrature::{ggx_albedo, phong_albedo};
use crate::stress::tools::surface::{ALBEDO, BsdfProbe, frame, probe, run, with_probes};

pub static ROW: Row = Row {
    name: "albedo",
    holds: "Lambert, Phong with Ns 0 to 1e5, GGX with alpha 1e-3 to 1, from 0 to 89 degrees: the albedo is the f64 integral",
    quantity: "difference of albedos",
    most: 1e-4,
    unit: "directions",
    sizes: [22_000_000, 22_000_000, 900_000_000],
    measure,
};

const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];
const LOBES: [Specular; 11] = [
    Phong(0.0),
    Phong(1.0),
    Phong(7.0),
    Phong(100.0),
    Phong(3e3),
    Phong(1e5),
    Ggx(1e-3),
    Ggx(0.02),
    Ggx(0.2),
    Ggx(0.6),
    Ggx(1.0),
];

/// Mean weight of a probe's draws, over the unit square.
fn mean(rig: &mut Runtime, probe: &BsdfProbe) -> Result<DVec3, GpuError> {
    let rows = run(rig, &ALBEDO, probe, probe.count as usize)?;
    Ok(rows.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / f64::from(probe.count))
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut rig = Runtime::new(lab.gpu().clone(), with_probes(lab.library().clone()));
    // Of 640 rows and columns the midpoint rule is good to 1e-5.
    let side = ((size / (LOBES.len() * ANGLES.len()) as u64) as f64).sqrt().max(640.0) as u32;
    let mut all = Measured::new(0.0, 0);
    for (k, lobe) in LOBES.into_iter().enumerate() {
        for degrees in ANGLES {
            let diffuse = if matches!(lobe, Phong(_)) { 0.5 } else { 0.0 };
            let both = BsdfProbe { count: side, ..probe(diffuse, 1.0 - diffuse, lobe, degrees) };
            let view = frame(&both);
            let cos_view = view.shading.dot(view.wo);
            let p = f64::from(both.material.specular_probability);
            let mut got = p * mean(&mut rig, &BsdfProbe { pick: 0.0, ..both })?;
            if p < 1.0 {
                got += (1.0 - p) * mean(&mut rig, &BsdfProbe { pick: 0.999_999, ..both })?;
            }
            let of_lobe = match lobe {
                Phong(ns) => phong_albedo(ns, cos_view),
                Ggx(alpha) => ggx_albedo(alpha, cos_view),
                Specular::Mirror => 1.0,
            };
            let right = both.material.kd.as_dvec3() + both.material.ks.as_dvec3() * of_lobe;
            let note = format!("{lobe:?} at {degrees} degrees");
            let off = greatest((got - right).abs().to_array());
            all = all.worst(Measured::new(off, u64::from(side * side)).noted(note));
        }
        lab.tell(k as u64 + 1, LOBES.len() as u64);
    }
    Ok(all)
}
