//! Coarse meshes with smooth normals where all around is equally bright.

use glam::{UVec2, Vec3};

use crate::components::{Energy, Lobe, Material, Passage};
use crate::layout::trace::TraceParams;
use crate::prepare::material;
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::room::Room;
use crate::stress::scenes::smooth::{add, meshes};
use crate::stress::tools::paths::samples;

pub static ROW: Row = Row {
    name: "coarse-balls",
    holds: "coarse smooth balls of glass, and these, a torus and a cube of mirror or metal, lose below 1 % of any pixel",
    quantity: "loss or gain of a pixel",
    most: 0.01,
    unit: "samples",
    sizes: [15 * 65_536, 15 * 65_536, 15 * 2_000_000],
    measure,
};

const SIDE: u32 = 16;

/// Segments of a path: total reflection keeps some light for long, as it does in flat facets.
const DEPTH: u32 = 1024;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let metal = Material { diffuse: Vec3::ONE, metallic: 1.0, lobe: Lobe::Ggx(0.02), ..Material::BLACK };
    let surfaces = [
        ("mirror", Material { specular: Vec3::ONE, lobe: Lobe::Mirror, ..Material::BLACK }),
        ("GGX", metal),
        ("glass", Material { passage: Passage::Glass(1.5), ..Material::BLACK }),
    ];
    let meshes = meshes();
    let layers = size.div_ceil((meshes.len() * surfaces.len()) as u64 * u64::from(SIDE * SIDE)).min(8192) as u32;
    let mut rig = lab.rig();
    let mut all = Measured::new(0.0, 0);
    for (k, (shape, mesh)) in meshes.iter().enumerate() {
        for (surface, values) in surfaces {
            // Total reflection may hold light in a solid for ever whose normals are of another shape.
            if surface == "glass" && !shape.starts_with("ball") {
                continue;
            }
            let mut room = Room { environment: Vec3::ONE, ..Room::default() };
            let of = room.material(material::pack(&values, Energy::Preserve));
            add(&mut room, mesh, Vec3::ZERO, 1.0, of);
            room.load(&mut rig)?;
            let got = samples(&mut rig, &TraceParams { layers, max_depth: DEPTH, ..room.params(UVec2::splat(SIDE)) })?;
            let pixels = (SIDE * SIDE) as usize;
            let mean = |at: usize| {
                got[at..].iter().step_by(pixels).map(|s| f64::from(s.rgb.x)).sum::<f64>() / f64::from(layers)
            };
            let worst = greatest((0..pixels).map(|at| (mean(at) - 1.0).abs()));
            all = all.worst(Measured::new(worst, got.len() as u64).noted(format!("{surface}, {shape}")));
        }
        lab.tell(k as u64 + 1, meshes.len() as u64);
    }
    Ok(all)
}
