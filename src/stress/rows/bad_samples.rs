//! Radiance that is no number.

use glam::{DVec3, UVec2, Vec3};

use crate::components::Camera;
use crate::layout::trace::{RadianceSample, SAMPLE_BAD, TraceParams};
use crate::prepare::camera;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::boxes::{furnace, inside};
use crate::stress::scenes::room::matte;
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "bad-samples",
    holds: "a sample that met NaN, infinity, less than nothing or too much says what, at which bounce and material",
    quantity: "samples that say otherwise",
    most: 0.0,
    unit: "samples",
    sizes: [2_048, 40_000, 4_000_000],
    measure,
};

const SIDE: u32 = 16;

/// Whether a sample is radiance, or says that it went wrong in this way.
fn is_told(sample: &RadianceSample, kind: u32, broken: u32) -> bool {
    if sample.info & SAMPLE_BAD == 0 {
        return sample.rgb.is_finite() && sample.rgb.min_element() >= 0.0;
    }
    let [got, bounce, material] = sample.rgb.to_array().map(|v| v as u32);
    (got, material) == (kind, broken) && sample.info & !SAMPLE_BAD == bounce + 1
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let cases = [(f32::NAN, 1), (f32::INFINITY, 2), (-100.0, 3), (1e38, 4)];
    let layers = size.div_ceil(u64::from(SIDE * SIDE) * cases.len() as u64).min(4096) as u32;
    let mut rig = lab.rig();
    let mut all = Measured::new(0.0, 0);
    for (k, (value, kind)) in cases.into_iter().enumerate() {
        // A wall that emits it, seen directly or after a bounce off the others.
        let mut room = furnace(0.5, 1.0);
        let broken = room.material(matte(Vec3::ZERO, Vec3::splat(value)));
        room.triangles[8].material = broken;
        room.triangles[9].material = broken;
        room.load(&mut rig)?;
        let size = UVec2::splat(SIDE);
        let mut params = TraceParams { layers, ..inside(&room, size, 3) };
        // Into the edge of the broken wall and a good one.
        let look_at = DVec3::new(1.0, 0.0, -1.0);
        let view = Camera { position: DVec3::ZERO, look_at, up: DVec3::Y, fov_y: 42.0, ..Camera::default() };
        camera::aim(&mut params, &view, size, DVec3::ZERO);
        camera::fit_film(&mut params, 40);
        let got = samples(&mut rig, &params)?;
        let other = got.iter().filter(|sample| !is_told(sample, kind, broken)).count();
        let bad = got.iter().filter(|sample| sample.info & SAMPLE_BAD != 0).count();
        if bad == 0 {
            return Err(StressError::Broken(format!("no sample met {value}")));
        }
        all = all.plus(Measured::new(other as f64, got.len() as u64).noted(format!("light of {value:e}")));
        lab.tell(k as u64 + 1, cases.len() as u64);
    }
    Ok(all)
}
