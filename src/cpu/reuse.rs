//! What a path lends to its tile, in f64: the twin of `passes/trace/reuse`.

use glam::DVec3;

use super::bsdf::{BsdfSample, Reflection, ShadingFrame};

/// The part of a path that it lends, from its second surface on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lending {
    /// What a unit of radiance along the ray adds to what that surface's diffuse lobe sends on; 0 before it.
    pub throughput: DVec3,
    /// Sent on so far.
    pub radiance: DVec3,
    /// The path lends from its next surface on.
    pub begins: bool,
}

/// Where a pixel gathers: its path's first surface.
#[derive(Clone, Copy, Debug)]
pub struct GatherPoint {
    pub position: DVec3,
    pub frame: ShadingFrame,
    pub surface: Reflection,
}

/// A path's second surface, and what its diffuse lobe sends on.
#[derive(Clone, Copy, Debug)]
pub struct LentPoint {
    pub position: DVec3,
    /// Index in scene order.
    pub triangle: u32,
    /// The triangle's normal on the side of the path.
    pub geometric: DVec3,
    /// What it is shaded by, before it is bent to a viewer.
    pub normal: DVec3,
    pub radiance: DVec3,
    /// The number by which surfaces with holes were there or not on the path's own way here.
    pub chance: u32,
    /// What a unit of radiance from here adds to the path's own pixel, where it keeps that to itself.
    pub weight: DVec3,
}

impl Lending {
    /// What of the light that a surface sends on is the path's own, and what it lends: `weight` is f * cos by `pdf`.
    pub fn parts_of(
        &self,
        throughput: DVec3,
        (surface, frame): (&Reflection, &ShadingFrame),
        direction: DVec3,
        weight: DVec3,
        pdf: f64,
    ) -> [DVec3; 2] {
        if !self.begins {
            return [throughput * weight, self.throughput * weight];
        }
        let diffuse = surface.seen_from_anywhere(frame, direction) / pdf;
        [throughput * (weight - diffuse), diffuse]
    }

    /// The same of a direction that a surface has drawn; the path goes on for both.
    pub fn lend_on(
        &self,
        throughput: DVec3,
        (surface, frame): (&Reflection, &ShadingFrame),
        drawn: &BsdfSample,
    ) -> [DVec3; 2] {
        if self.begins && drawn.pdf == 0.0 {
            return [throughput * drawn.weight, DVec3::ZERO];
        }
        self.parts_of(throughput, (surface, frame), drawn.direction, drawn.weight, drawn.pdf)
    }
}
