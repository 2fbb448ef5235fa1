//! See-through sheets behind each other: hundreds before the sky, and some before a lamp.

use glam::{UVec2, Vec3};

use crate::components::{Energy, Material, Passage};
use crate::layout::trace::TraceParams;
use crate::prepare::material;
use crate::stats::agreement::MOST_ERRORS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::covered::{Covered, PLAIN};
use crate::stress::scenes::room::Room;
use crate::stress::tools::paths::{as_measured, compare, kernel, paths_of, samples};

pub static ROW: Row = Row {
    name: "veils",
    holds: "hundreds of sheets let through the product of what each does, and a shadow ray through some as much as a path",
    quantity: "standard errors",
    most: MOST_ERRORS,
    unit: "samples",
    sizes: [65_536, 500_000, 4_000_000],
    measure,
};

const SIDE: u32 = 32;

/// Sheets before the lamp, and samples a pixel and batch of it: standard errors of a quarter of a percent.
const BEFORE_LAMP: u32 = 6;
const LAYERS: u32 = 1600;

fn veil(opacity: f32) -> Material {
    Material { passage: Passage::SeeThrough(opacity), filter: Vec3::ONE, ..Material::BLACK }
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let sky = before_the_sky(lab, size)?;
    Ok(sky.worst(before_a_lamp(lab)?))
}

/// How far what passes is from the product.
fn before_the_sky(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    // Where loops end at 65,535 rounds, there is no path through a thousand.
    let sheets = if lab.is_software() { 100 } else { 1000 };
    let opacity = 0.5 / sheets as f32;
    let mut room = Room { environment: Vec3::ONE, ..Room::default() };
    let of = room.material(material::pack(&veil(opacity), Energy::Preserve));
    for i in 0..sheets {
        let z = 1.0 - 2.0 * i as f32 / sheets as f32;
        room.quad(Vec3::new(-9.0, -9.0, z), 18.0 * Vec3::X, 18.0 * Vec3::Y, of);
    }
    let layers = size.div_ceil(u64::from(SIDE * SIDE)) as u32;
    let mut rig = lab.rig();
    room.load(&mut rig)?;
    let (mut sum, mut count, mut first_sample) = (0.0, 0, 0);
    while first_sample < layers {
        let layers = (layers - first_sample).min(16);
        let params = TraceParams { layers, first_sample, max_depth: sheets + 4, ..room.params(UVec2::splat(SIDE)) };
        let got = samples(&mut rig, &params)?;
        sum += got.iter().map(|sample| f64::from(sample.rgb.x)).sum::<f64>();
        count += got.len() as u64;
        first_sample += layers;
        lab.tell(count, 2 * size);
    }
    // Every sample is 0 or 1.
    let right = (1.0 - f64::from(opacity)).powi(sheets as i32);
    let error = (right * (1.0 - right) / count as f64).sqrt();
    let mean = sum / count as f64;
    let note = format!("{sheets} sheets of {opacity:e}: {mean:.5}, the product {right:.5}");
    Ok(Measured::new((mean - right).abs() / error, count).noted(note))
}

/// Whether light sampling and chance agree on a lamp behind sheets.
fn before_a_lamp(lab: &Lab) -> Result<Measured, StressError> {
    let stage = Covered { lamps: vec![Vec3::splat(5.0)], ..PLAIN };
    let mut room = stage.room();
    let of = room.material(material::pack(&veil(0.2), Energy::Preserve));
    for i in 0..BEFORE_LAMP {
        let y = 0.7 + 0.04 * i as f32;
        room.quad(Vec3::new(-2.0, y, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z, of);
    }
    let sampling = Room { next_event: true, ..room.clone() };
    let of_room = |room: &Room, seed| TraceParams { seed, max_depth: 2 + BEFORE_LAMP, ..stage.params(room, LAYERS) };
    let params = of_room(&room, 1);
    let agreement = compare(
        kernel(lab.gpu(), lab.library().clone(), &sampling, &of_room(&sampling, 2))?,
        kernel(lab.gpu(), lab.library().clone(), &room, &params)?,
    )?;
    Ok(as_measured(agreement, 2 * paths_of(&params), "sheets before a lamp, path and bsdf"))
}
