//! Whether two paths are one but for rounding, and if they part, why.

use super::Sample;
use super::compare::{Comparison, Parting, Row, compare};
use super::quantities::{STEPS, Step, numbers_of};
use super::replay;
use super::shaken::{OfNormals, shaken};
use crate::cpu::path::{PathScene, Walked};
use crate::cpu::turn::{RayKind, Turn};
use crate::layout::trace::TraceParams;

/// Paths that are shaken to know what rounding explains; where a number seems to be off by more, and where a decision is another.
const FEW: u64 = 16;
const MANY: u64 = 96;

/// By how many times as much as a step may be off the steps of those paths are; the last is more than rounding.
const SCALES: [f64; 3] = [1.0, 4.0, 16.0];

/// Up to this it is called rounding.
const MOST_SCALE: f64 = 4.0;

/// What is known of a path once kernel and twin have walked it.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub twin: Vec<Turn>,
    pub walked: Walked,
    pub comparison: Comparison,
    /// Of the parting, if they part.
    pub why: Option<Why>,
}

/// Why two paths part.
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// A number of the kernel's is none: NaN or infinite.
    NoNumber,
    /// Of `of` paths of the twin whose steps are off by `scale` roundings, `with` decide as the kernel did.
    Shaken { scale: f64, with: u64, of: u64 },
    /// The kernel's ray hits the very triangle that it leaves, so far away: its origin is not as far off it as its own test of it errs.
    SelfHit { t: f64 },
    /// The kernel's ray, followed in f64, hits what the kernel says: the rays are apart by rounding.
    SameRay,
    /// The two triangles are so far apart along the kernel's ray, by their distance from its origin, and it meets the kernel's so far outside of its
    /// edges, in weights of its corners.
    NearTie { gap: f64, outside: f64 },
    /// More than rounding explains.
    Unexplained,
}

impl Verdict {
    /// Whether the two are one path, or rounding alone parts them.
    pub fn is_explained(&self) -> bool {
        self.why.as_ref().is_none_or(Why::is_rounding)
    }
}

impl Why {
    /// Whether it is rounding.
    pub fn is_rounding(&self) -> bool {
        match self {
            Self::Shaken { scale, .. } => *scale <= MOST_SCALE,
            Self::SameRay | Self::NearTie { .. } => true,
            Self::NoNumber | Self::SelfHit { .. } | Self::Unexplained => false,
        }
    }
}

/// Judges what the kernel kept of a path.
pub fn judge(scene: &PathScene, params: &TraceParams, of: Sample, gpu: &[Turn]) -> Verdict {
    let (twin, walked) = replay(scene, params, of);
    let paths = |scale: f64, normals: OfNormals, seeds: std::ops::Range<u64>| -> Vec<Vec<Turn>> {
        seeds.map(|seed| shaken(scene, params, of, (scale, normals), seed)).collect()
    };
    let few = paths(1.0, OfNormals::Parts, 0..FEW);
    let mut comparison = compare(gpu, &twin, &few);
    if comparison.parting.as_ref().is_some_and(|parting| parting.row.is_some()) {
        let all: Vec<Vec<Turn>> = few.into_iter().chain(paths(1.0, OfNormals::Parts, FEW..MANY)).collect();
        comparison = compare(gpu, &twin, &all);
    }
    let why = comparison.parting.as_ref().map(|parting| match &parting.row {
        Some(row) if row.gpu.numbers().iter().any(|number| !number.is_finite()) => Why::NoNumber,
        Some(row) => {
            let all = paths(1.0, OfNormals::All, 0..MANY);
            let with = all.iter().filter(|path| comes_to(parting, row, path)).count() as u64;
            if with > 0 { Why::Shaken { scale: 1.0, with, of: MANY } } else { Why::Unexplained }
        }
        None => {
            if let Some(t) = self_hit(parting, gpu) {
                return Why::SelfHit { t };
            }
            let found = SCALES.iter().find_map(|scale| {
                let all = paths(*scale, OfNormals::All, 0..MANY);
                let with = all.iter().filter(|path| decides_as(parting, path, gpu, &twin)).count() as u64;
                (with > 0).then_some(Why::Shaken { scale: *scale, with, of: MANY })
            });
            found.filter(Why::is_rounding).or_else(|| of_ray(scene, parting, gpu, &twin)).unwrap_or(Why::Unexplained)
        }
    });
    Verdict { twin, walked, comparison, why }
}

/// How near a path has to come to a number of the kernel's that is far from the twin's.
const ALIKE: f64 = 1e-4;

/// Whether a path comes to what the kernel does where its number is another: a frame about a normal may be turned.
fn comes_to(parting: &Parting, row: &Row, path: &[Turn]) -> bool {
    let turn = path.get(parting.turn);
    let number = turn.and_then(|turn| numbers_of(turn).find(|(name, _)| *name == row.name));
    let size = row.gpu.largest().max(f64::MIN_POSITIVE);
    row.difference > ALIKE && number.is_some_and(|(_, values)| values.distance(&row.gpu) <= ALIKE * size)
}

/// Where a segment hits the triangle that it leaves, which is flat: by its own rounding alone.
fn self_hit(parting: &Parting, gpu: &[Turn]) -> Option<f64> {
    let met = gpu.get(parting.turn).filter(|turn| turn.kind == RayKind::Segment)?.met?;
    let left = gpu[..parting.turn].iter().rev().find(|turn| turn.kind == RayKind::Segment)?.met?;
    (parting.name == "triangle" && met.triangle == left.triangle).then_some(met.t)
}

/// Whether a path decides all as the twin does before a parting, and there as the kernel.
fn decides_as(parting: &Parting, path: &[Turn], gpu: &[Turn], twin: &[Turn]) -> bool {
    if parting.turn >= gpu.len().min(twin.len()) {
        return path.len() == gpu.len();
    }
    for (i, turn) in path.iter().enumerate().take(parting.turn + 1) {
        for step in STEPS {
            let Step::Choice(choice) = step else { continue };
            let parts = i == parting.turn && choice.name == parting.name;
            let wanted = if parts { &gpu[i] } else { &twin[i] };
            if (choice.of)(turn) != (choice.of)(wanted) {
                return false;
            }
            if parts {
                return true;
            }
        }
    }
    false
}

/// By how much a meeting may be outside of a triangle, in weights of its corners, or before another, as part of the way.
const NEAR: f64 = 1e-5;

/// What the kernel's own ray says of a triangle that is another.
fn of_ray(scene: &PathScene, parting: &Parting, gpu: &[Turn], twin: &[Turn]) -> Option<Why> {
    let (ours, right) = (gpu.get(parting.turn)?, twin.get(parting.turn)?);
    if parting.name != "triangle" || ours.kind != RayKind::Segment {
        return None;
    }
    let (origin, direction) = (ours.origin, ours.direction);
    let met = ours.met?;
    let hit = scene.triangles.closest(origin, direction, 0.0).map(|hit| hit.triangle.index);
    if hit == Some(met.triangle) {
        return Some(Why::SameRay);
    }
    let [own, other] = [Some(met), right.met].map(|met| scene.triangles.plane_of(met?.triangle, origin, direction));
    let (own, other) = (own?, other?);
    let outside = own.b.iter().chain([&(1.0 - own.b[0] - own.b[1])]).fold(0.0f64, |most, b| most.max(-b));
    let gap = (own.t - other.t).abs() / own.t.abs().max(f64::MIN_POSITIVE);
    (gap <= NEAR && outside <= NEAR).then_some(Why::NearTie { gap, outside })
}
