//! Random numbers, elementary functions, sampling and BSDFs on the GPU, against f64.

mod cells;
mod coat;
mod draws;
mod elementary;
mod furnace;
mod pack;
mod pane;
mod specular;
mod tilted;

use glam::{DVec3, Vec4};
use lucerna::cpu::bsdf::ShadingFrame;
use lucerna::gpu::Runtime;
use lucerna::passes::Pass;
use lucerna::shader::Library;
use lucerna::stress::tools::surface::{self, with_probes};
pub use lucerna::stress::tools::surface::{ALBEDO, BsdfProbe, DRAW, ELEMENTARY, SPLIT, frame, look, probe};

use crate::support;

fn library() -> Library {
    with_probes(Library::shipped())
}

fn rig() -> Runtime {
    Runtime::new(support::gpu(), library())
}

/// Runs a probe, compiled for its material alone.
fn run(rig: &mut Runtime, pass: &'static Pass, params: &BsdfProbe, words: usize) -> Vec<Vec4> {
    surface::run(rig, pass, params, words).unwrap()
}

/// A draw of the kernel, and what it says of that direction.
struct Draw {
    direction: DVec3,
    pdf: f64,
    weight: DVec3,
    /// Of the whole mixture in that direction.
    evaluated: f64,
}

fn draws(rig: &mut Runtime, probe: &BsdfProbe) -> Vec<Draw> {
    let rows = run(rig, &DRAW, probe, 3 * probe.count as usize);
    let draw = |row: &[Vec4]| Draw {
        direction: row[0].truncate().as_dvec3().normalize(),
        pdf: f64::from(row[0].w),
        weight: row[1].truncate().as_dvec3(),
        evaluated: f64::from(row[1].w),
    };
    rows.chunks_exact(3).map(draw).collect()
}

/// The same on a facet whose own normal leans off the shading normal by `lean` degrees, `turn` turns from the viewer's side.
fn leaning(probe: BsdfProbe, lean: f64, turn: f64) -> BsdfProbe {
    let ShadingFrame { wo, shading: n, .. } = frame(&probe);
    let side = wo.reject_from_normalized(n).normalize();
    let away = side.rotate_axis(n, turn * std::f64::consts::TAU);
    let geometric = n * lean.to_radians().cos() + away * lean.to_radians().sin();
    assert!(geometric.dot(wo) > 0.0, "the facet is not seen");
    BsdfProbe { geometric: geometric.as_vec3(), ..probe }
}
