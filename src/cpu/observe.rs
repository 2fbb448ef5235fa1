//! Who watches a path of the twin: nobody, who notes its rays, or who shakes its numbers as rounding would.

use glam::DVec3;

use super::bsdf::ShadingFrame;
use super::triangles::HitF64;
use super::turn::Turn;

/// Hears of a path as it is walked. Of a path that nobody watches all of this is compiled to nothing.
pub trait Observer {
    /// A ray was traced.
    fn turn(&mut self, _turn: impl FnOnce() -> Turn) {}

    /// More is known of the segment that was traced last.
    fn note(&mut self, _fill: impl FnOnce(&mut Turn)) {}

    /// More is known of the ray that was traced last.
    fn note_last(&mut self, _fill: impl FnOnce(&mut Turn)) {}

    /// What the path goes on with instead of a unit vector.
    fn unit(&mut self, v: DVec3) -> DVec3 {
        v
    }

    /// And instead of a normal.
    fn normal(&mut self, n: DVec3) -> DVec3 {
        n
    }

    /// And instead of a random number, which is compared with a probability.
    fn number(&mut self, u: f64) -> f64 {
        u
    }

    /// And instead of a point of a triangle.
    fn place(&mut self, _hit: &mut HitF64, position: DVec3) -> DVec3 {
        position
    }

    /// Where a ray in a direction leaves from such a point.
    fn leave(&mut self, _hit: &HitF64, position: DVec3, _frame: &ShadingFrame, _direction: DVec3) -> DVec3 {
        position
    }
}

/// Nobody.
pub struct Unwatched;

impl Observer for Unwatched {}
