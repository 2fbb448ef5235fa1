//! Glass that bends nothing.

use glam::{UVec2, Vec3};

use crate::components::{Energy, Material, Passage};
use crate::layout::trace::TraceParams;
use crate::prepare::material;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::{Room, matte};
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "glass-of-1",
    holds: "two shells of glass with Ni 1 are invisible to 1e-4, before walls that glow in other colours",
    quantity: "part of the samples that differ",
    // Two rays of a thousand may pass another side of a wall's edge: their origins were moved.
    most: 2e-3,
    unit: "samples",
    sizes: [9_000, 200_000, 50_000_000],
    measure,
};

/// Walls that only glow: what is seen depends on nothing random but the place in the pixel.
fn glowing() -> Room {
    let mut room = Room { environment: Vec3::new(0.5, 0.1, 0.9), ..Room::default() };
    let walls: Vec<_> = (1..6).map(|i| Some(room.material(matte(Vec3::ZERO, Vec3::new(i as f32, 0.5, 1.0))))).collect();
    room.walls([walls[0], walls[1], walls[2], walls[3], walls[4], None]);
    room
}

/// The part of the samples that shells of such glass change by more than 1e-4.
fn changed(lab: &Lab, ni: f32, layers: u32) -> Result<(f64, u64), StressError> {
    let bare = glowing();
    let params = TraceParams { layers, ..bare.params(UVec2::splat(48)) };
    let mut rig = lab.rig();
    bare.load(&mut rig)?;
    let right = samples(&mut rig, &params)?;
    let mut room = bare.clone();
    let glass = Material { passage: Passage::Glass(ni), ..Material::BLACK };
    let shell = room.material(material::pack(&glass, Energy::Preserve));
    for radius in [0.8, 0.7] {
        room.ball(Vec3::new(0.1, 0.0, -0.1), radius, shell);
    }
    room.load(&mut rig)?;
    let got = samples(&mut rig, &TraceParams { root: room.params(UVec2::ONE).root, ..params })?;
    let differs = |a: Vec3, b: Vec3| (a - b).abs().max_element() > 1e-4 * b.max_element() || !a.is_finite();
    let count = got.iter().zip(&right).filter(|(a, b)| differs(a.rgb, b.rgb)).count();
    Ok((count as f64 / got.len() as f64, got.len() as u64))
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let layers = size.div_ceil(48 * 48).min(4096) as u32;
    let (part, samples) = changed(lab, 1.0, layers)?;
    lab.tell(1, 2);
    let (visible, _) = changed(lab, 1.001, 4)?;
    if visible <= ROW.most {
        return Err(StressError::Broken("glass with Ni 1.001 is as invisible".to_owned()));
    }
    Ok(Measured::new(part, samples).noted(format!("Ni 1.001 changes {:.2} %", 100.0 * visible)))
}
