//! A path of the twin whose every step is off by as much as a step of the kernel may be: what becomes of that by the path's end is what
//! rounding explains. Random rounding instead of bounds that are carried on (Parker, Monte Carlo Arithmetic, 1997): it knows of grazing rays, of
//! curved mirrors and of thin lobes what they make of an error, without being told.

use glam::DVec3;

use super::Sample;
use super::record::{Recorder, slack_at};
use crate::cpu::bsdf::ShadingFrame;
use crate::cpu::observe::Observer;
use crate::cpu::path::PathScene;
use crate::cpu::triangles::HitF64;
use crate::cpu::turn::Turn;
use crate::layout::trace::TraceParams;

/// A component of a unit vector is off by up to this: eight roundings, for sine and cosine of drivers err by some 2^-21.
const OF_UNIT: f64 = 1.0 / (1 << 21) as f64;

/// And a number in [0, 1) that is compared with a probability: two roundings.
const OF_NUMBER: f64 = 1.0 / (1 << 23) as f64;

/// Draws of a place before one is taken that is not moved: the others would have left the triangle.
const TRIES: usize = 4;

/// Walks a path, shaken.
struct Shaken {
    recorder: Recorder,
    /// Of the generator.
    state: u64,
    /// By which all errors are multiplied.
    scale: f64,
    of_normals: OfNormals,
}

/// How normals are shaken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfNormals {
    /// Each component by a part of itself: those of a wall along the axes stay 0, as they are in f32.
    Parts,
    /// All alike, so that one that is 0 but for rounding takes either sign: where a frame about the normal is chosen by that, directions turn.
    All,
}

/// The rays of a path whose steps are off by `scale` roundings; each `seed` shakes them otherwise.
pub fn shaken(
    scene: &PathScene,
    params: &TraceParams,
    of: Sample,
    (scale, of_normals): (f64, OfNormals),
    seed: u64,
) -> Vec<Turn> {
    let mut shaken = Shaken { recorder: Recorder::default(), state: seed, scale, of_normals };
    scene.walk_watched(params, of.pixel, of.sample, of.lends, &mut shaken);
    shaken.recorder.turns
}

impl Shaken {
    /// Evenly from -1 to 1 (SplitMix64: Steele, Lea, Flood 2014).
    fn draw(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.state;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^= word >> 31;
        (word >> 11) as f64 * 2f64.powi(-52) - 1.0
    }
}

impl Observer for Shaken {
    fn turn(&mut self, turn: impl FnOnce() -> Turn) {
        self.recorder.turn(turn);
    }

    fn note(&mut self, fill: impl FnOnce(&mut Turn)) {
        self.recorder.note(fill);
    }

    fn note_last(&mut self, fill: impl FnOnce(&mut Turn)) {
        self.recorder.note_last(fill);
    }

    fn unit(&mut self, v: DVec3) -> DVec3 {
        v + self.scale * OF_UNIT * DVec3::new(self.draw(), self.draw(), self.draw())
    }

    fn normal(&mut self, n: DVec3) -> DVec3 {
        match self.of_normals {
            OfNormals::All => self.unit(n),
            OfNormals::Parts => n + n * (self.unit(n) - n),
        }
    }

    fn number(&mut self, u: f64) -> f64 {
        (u + self.scale * OF_NUMBER * self.draw()).clamp(0.0, 1.0 - f64::EPSILON)
    }

    /// Within the triangle: the twin's rays leave from its very plane.
    fn place(&mut self, hit: &mut HitF64, position: DVec3) -> DVec3 {
        self.recorder.place(hit, position);
        let by = self.scale * slack_at(hit, position, DVec3::Z).position;
        let [a, b, c] = hit.triangle.corners;
        let area_normal = (b - a).cross(c - a);
        let n = area_normal.normalize_or_zero();
        let e = (b - a).normalize_or_zero();
        for _ in 0..TRIES {
            let shift = by * (self.draw() * e + self.draw() * n.cross(e));
            let change = [shift.cross(c - a), (b - a).cross(shift)].map(|part| part.dot(n) / area_normal.length());
            let moved = [hit.b[0] + change[0], hit.b[1] + change[1]];
            if moved[0] >= 0.0 && moved[1] >= 0.0 && moved[0] + moved[1] <= 1.0 {
                hit.b = moved;
                return position + shift;
            }
        }
        position
    }

    /// Off the triangle to the side of the direction, as the kernel's rays.
    fn leave(&mut self, hit: &HitF64, position: DVec3, frame: &ShadingFrame, direction: DVec3) -> DVec3 {
        let by = slack_at(hit, position, direction).offset * (1.0 + self.draw());
        position + frame.geometric * by.copysign(direction.dot(frame.geometric))
    }
}
