//! A pane of glass by what happens within: light enters or not, crosses from face to face, and at each leaves or is sent back.

use glam::DVec3;

use super::facing::{Draw, Facing};
use super::lobes::fresnel;
use super::random::Random;

/// Crossings after which what is left is dropped: of light that comes at less than a ten thousandth of a right angle.
const MOST: u32 = 100_000;

/// A way on; `tf` is what a crossing leaves.
pub fn draw_pane(index: f64, tf: DVec3, facing: &Facing, random: &mut Random) -> Option<Draw> {
    let cos = facing.wo.dot(facing.shading);
    let within = (1.0 - (1.0 - cos * cos) / (index * index)).max(0.0).sqrt();
    // At either face, from either side (Stokes).
    let reflected = fresnel(1.0 / index, cos, within);
    let mirrored = |weight: DVec3| Some(Draw { wi: facing.leaving(facing.mirror()), weight, pdf: 0.0 });
    if random.unit() < reflected {
        return mirrored(DVec3::ONE);
    }
    let mut weight = DVec3::ONE;
    for crossing in 0..MOST {
        weight *= tf;
        if random.unit() >= reflected {
            return match crossing % 2 {
                0 => Some(Draw { wi: -facing.wo, weight, pdf: 0.0 }),
                _ => mirrored(weight),
            };
        }
    }
    None
}
