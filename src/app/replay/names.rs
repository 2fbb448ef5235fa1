//! What vertices and decisions are called.

use super::numbers::number;
use crate::cpu::replay::{Parting, Why};
use crate::cpu::turn::{RayKind, Turn};
use crate::engine::{ProbedValue, Replay};
use crate::layout::trace::{BAD_INFINITE, BAD_NAN, BAD_NEGATIVE, BAD_OVERFLOW};

/// What a triangle is part of.
pub fn triangle(replay: &Replay, triangle: u32) -> String {
    match replay.place(triangle) {
        Some(place) => {
            let material = place.material.as_deref().unwrap_or("default");
            format!("{} (material {material}), triangle {}", place.mesh, place.of_mesh)
        }
        None => format!("triangle {triangle} of all"),
    }
}

/// Where a ray ends.
pub fn end(replay: &Replay, turn: &Turn) -> String {
    turn.met.map_or("nothing".to_owned(), |met| triangle(replay, met.triangle))
}

/// A ray, by the vertex that it comes to, or from.
pub fn ray(turn: &Turn) -> String {
    match turn.kind {
        RayKind::Segment => format!("vertex {}", turn.bounce + 1),
        RayKind::Shadow => format!("light of vertex {}", turn.bounce + 1),
    }
}

/// Why two paths part.
pub fn why(why: &Why) -> String {
    match why {
        Why::NoNumber => "the GPU's is no number".to_owned(),
        Why::Shaken { scale, with, of } => format!(
            "rounding: of {of} walks of the twin whose steps are off by {} f32's, {with} do so too",
            if *scale == 1.0 { "as much as".to_owned() } else { format!("{scale} times") }
        ),
        Why::SelfHit { t } => {
            format!("a defect: the GPU's ray hits the triangle that it leaves, at {t:.1e}")
        }
        Why::SameRay => "rounding: the GPU's own ray, followed in f64, hits that triangle too".to_owned(),
        Why::NearTie { gap, outside } => {
            format!("rounding: the two are {gap:.0e} apart in t, and the ray is {outside:.0e} outside of an edge")
        }
        Why::Unexplained => "more than rounding explains".to_owned(),
    }
}

/// What both say where they part.
pub fn decided(replay: &Replay, parting: &Parting) -> String {
    let [ours, right] = [&replay.gpu, &replay.verdict.twin].map(|path| path.get(parting.turn));
    match (parting.name, ours, right) {
        ("triangle", Some(ours), Some(right)) => {
            format!("the GPU hits {}; the twin {}", end(replay, ours), end(replay, right))
        }
        ("number of rays", ..) => {
            format!("the GPU traces {} rays; the twin {}", replay.gpu.len(), replay.verdict.twin.len())
        }
        (name, ..) => format!("the two decide otherwise whether: {name}"),
    }
}

/// A ray that all but misses its triangle: by which angle, degrees.
pub fn grazes(turn: &Turn) -> Option<f64> {
    const GRAZING: f64 = 0.05;
    (turn.met.is_some() && turn.slack.cos < GRAZING).then(|| turn.slack.cos.asin().to_degrees())
}

/// A number that code shows.
pub fn probed(value: &ProbedValue) -> String {
    match value {
        ProbedValue::Numbers(numbers) => {
            let texts: Vec<String> = numbers.iter().map(|x| number((*x).into())).collect();
            texts.join(" ")
        }
        ProbedValue::Whole(whole) => whole.to_string(),
        ProbedValue::Switch(on) => on.to_string(),
    }
}

/// What is wrong with a bad sample.
pub fn fault(kind: u32) -> &'static str {
    match kind {
        BAD_NAN => "NaN",
        BAD_INFINITE => "infinite",
        BAD_NEGATIVE => "negative",
        BAD_OVERFLOW => "too large for the film",
        _ => "bad",
    }
}
