//! What the oracle says of the same vertices: it shares nothing with kernel and twin, so an error that both have shows here.

use glam::DVec3;

use crate::cpu::turn::{RayKind, Turn};
use crate::engine::Replay;
use crate::oracle::{Oracle, Vertex};

/// Of a segment's end.
#[derive(Clone, Debug)]
pub struct Third {
    /// None where nothing is hit.
    pub vertex: Option<Vertex>,
    /// What arrives along the segment.
    pub emitted: DVec3,
    /// Each beside the kernel's: towards the light, and in the direction that was drawn.
    pub light: Option<Beside>,
    pub drawn: Option<Beside>,
}

/// f * cos of a direction.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    pub value: DVec3,
    /// With which the oracle would draw it: by its own choice of lobes.
    pub pdf: f64,
    pub gpu: DVec3,
}

impl Beside {
    /// By how much the kernel is off, as a part.
    pub fn difference(&self) -> f64 {
        let largest = self.value.abs().max_element().max(self.gpu.abs().max_element());
        if largest == 0.0 { 0.0 } else { (self.value - self.gpu).abs().max_element() / largest }
    }
}

/// Of each ray of the kernel's; none of shadow rays.
pub fn of_path(oracle: &Oracle, replay: &Replay) -> Vec<Option<Third>> {
    let of = |turn: &Turn| (turn.kind == RayKind::Segment).then(|| of_segment(oracle, replay.origin, turn));
    replay.gpu.iter().map(of).collect()
}

fn of_segment(oracle: &Oracle, origin: DVec3, turn: &Turn) -> Third {
    let Some(met) = turn.met else {
        return Third { vertex: None, emitted: oracle.beyond(turn.direction).0, light: None, drawn: None };
    };
    let light = turn.light.map(|light| (light.direction, light.value));
    let drawn = turn.drawn.filter(|drawn| drawn.pdf > 0.0).map(|drawn| (drawn.direction, drawn.weight * drawn.pdf));
    let asked: Vec<(DVec3, DVec3)> = light.into_iter().chain(drawn).collect();
    let from: Vec<DVec3> = asked.iter().map(|(direction, _)| *direction).collect();
    let vertex = oracle.vertex(origin + turn.origin, turn.direction, met.triangle, &from);
    let values =
        vertex.as_ref().filter(|vertex| vertex.triangle == met.triangle).and_then(|vertex| vertex.values.clone());
    let mut beside = values.into_iter().flatten().zip(asked).map(|((value, pdf), (_, gpu))| Beside { value, pdf, gpu });
    let emitted = vertex.as_ref().map_or(DVec3::ZERO, |vertex| vertex.emitted);
    let light = light.and_then(|_| beside.next());
    let drawn = drawn.and_then(|_| beside.next());
    Third { vertex, emitted, light, drawn }
}
