//! What the rays of a path bring, in f64: the twin of `passes/trace/sources`.

use glam::DVec3;

use crate::cpu::path::{PathScene, Walked};
use crate::cpu::replay::{Sample, replay};
use crate::cpu::sun::SunDisk;
use crate::cpu::surface::is_bent;
use crate::cpu::turn::{RayKind, Turn};
use crate::layout::sources::{Contribution, LIGHT_POINT, LIGHT_SKY, LIGHT_SUN, WAY_FOUND, WAY_SAMPLED, WAY_SEEN};
use crate::layout::trace::{NO_MATERIAL, TraceParams};

/// What the rays of a path bring its pixel, in their order, and what it comes to.
pub fn brought(scene: &PathScene, params: &TraceParams, of: Sample) -> (Vec<Contribution>, Walked) {
    let (turns, walked) = replay(scene, params, of);
    let sun = SunDisk::new(params);
    let beyond = |direction| if sun.is_some_and(|sun| sun.covers(direction)) { LIGHT_SUN } else { LIGHT_SKY };
    let mut all = Vec::new();
    // The way of what is found at the end of the next segment, and of what the surface there samples.
    let mut found =
        Contribution { surface: NO_MATERIAL, through: NO_MATERIAL, way: WAY_SEEN, ..Contribution::default() };
    let mut sampled = found;
    for turn in &turns {
        let way = match turn.kind {
            RayKind::Shadow => sampled,
            RayKind::Segment => {
                let light = turn.met.map_or_else(|| beyond(turn.direction), |met| met.triangle);
                let way = Contribution { light, ..found };
                sampled = sampled_by(turn, &found, beyond);
                found = scattered(scene, turn, found);
                way
            }
        };
        if turn.added != DVec3::ZERO {
            all.push(Contribution { rgb: turn.added.as_vec3(), ..way });
        }
    }
    (all, walked)
}

/// The way of a light that was sampled at the end of a segment.
fn sampled_by(turn: &Turn, found: &Contribution, beyond: impl Fn(DVec3) -> u32) -> Contribution {
    let surface = turn.met.map_or(NO_MATERIAL, |met| met.material);
    let light = turn.light.map_or(LIGHT_SKY, |light| match (light.triangle, light.point) {
        (Some(triangle), _) => triangle,
        (None, Some(row)) => LIGHT_POINT + row,
        (None, None) => beyond(light.direction),
    });
    let bounce = found.bounce + 1;
    Contribution { surface, light, bounce, through: NO_MATERIAL, way: WAY_SAMPLED, ..Contribution::default() }
}

/// The way of what is found behind the surface at the end of a segment.
fn scattered(scene: &PathScene, turn: &Turn, found: Contribution) -> Contribution {
    let (Some(met), Some(drawn)) = (turn.met, turn.drawn.filter(|drawn| drawn.goes_on)) else { return found };
    let bends = || is_bent(&scene.materials[met.material as usize], &scene.textures.maps(met.material));
    if drawn.pdf == 0.0 && drawn.direction == turn.direction && !bends() {
        return found;
    }
    let bounce = found.bounce + 1;
    match drawn.pdf > 0.0 {
        true => Contribution { bounce, surface: met.material, through: NO_MATERIAL, way: WAY_FOUND, ..found },
        false => Contribution { bounce, through: met.material, ..found },
    }
}
