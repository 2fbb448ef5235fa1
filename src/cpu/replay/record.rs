//! Notes the rays of a path of the twin.

use glam::DVec3;

use crate::cpu::observe::Observer;
use crate::cpu::triangles::HitF64;
use crate::cpu::turn::{RayKind, Slack, Turn};
use crate::layout::ray::INSET;

/// What was noted so far.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    pub turns: Vec<Turn>,
    /// The segment that was traced last.
    segment: usize,
}

impl Observer for Recorder {
    fn turn(&mut self, turn: impl FnOnce() -> Turn) {
        let turn = turn();
        if turn.kind == RayKind::Segment {
            self.segment = self.turns.len();
        }
        self.turns.push(turn);
    }

    fn note(&mut self, fill: impl FnOnce(&mut Turn)) {
        if let Some(turn) = self.turns.get_mut(self.segment) {
            fill(turn);
        }
    }

    fn note_last(&mut self, fill: impl FnOnce(&mut Turn)) {
        if let Some(turn) = self.turns.last_mut() {
            fill(turn);
        }
    }

    fn place(&mut self, hit: &mut HitF64, position: DVec3) -> DVec3 {
        let slack = slack_at(hit, position, self.turns.get(self.segment).map_or(DVec3::Z, |turn| turn.direction));
        self.note(|turn| turn.slack = slack);
        position
    }
}

/// By how much the kernel's point of a triangle differs: the error bound that it has itself (`surface_point` in `lib/intersect`), and near an
/// edge the distance to which it keeps from it.
pub fn slack_at(hit: &HitF64, position: DVec3, direction: DVec3) -> Slack {
    const OF_COORDINATES: f64 = 4.172_325_69e-7;
    const OF_REACH: f64 = 4.768_371_582_031_25e-7;
    let [a, b, c] = hit.triangle.corners;
    let b0 = 1.0 - hit.b[0] - hit.b[1];
    let weights = [b0, hit.b[0], hit.b[1]];
    let corners = [a, b, c];
    let of = |value: &dyn Fn(DVec3) -> f64| corners.iter().zip(weights).map(|(p, w)| w.abs() * value(*p)).sum::<f64>();
    let rounding = OF_COORDINATES * of(&|p| p.abs().max_element());
    let error = rounding + OF_REACH * of(&|p| p.distance(position));
    let area_normal = (b - a).cross(c - a);
    let longest = [b - a, c - b, a - c].map(DVec3::length).into_iter().fold(0.0, f64::max);
    let height = area_normal.length() / longest.max(f64::MIN_POSITIVE);
    let margin = f64::from(INSET) * error;
    let near_edge = weights.into_iter().fold(f64::MAX, f64::min) * height <= 2.0 * margin;
    Slack {
        position: if near_edge { margin } else { error },
        offset: error,
        weights: error / height.max(f64::MIN_POSITIVE),
        cos: area_normal.normalize_or_zero().dot(direction).abs(),
    }
}
