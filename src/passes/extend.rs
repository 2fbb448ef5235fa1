//! Ray queries as passes of their own: rays in, hits out.

use super::textures::texture_bindings;
use super::tree::PLAN;
use super::twin::twin;
use super::{Binding, Pass, Recording, Size};
use crate::layout::ray::{ExtendParams, Hit, Ray};

/// The closest hit of every ray.
pub static EXTEND: Pass = Pass {
    name: "extend",
    module: "passes/trace/extend",
    entry: "extend",
    features: &[],
    bindings: &Binding::list::<9>(&[
        &[
            Binding::read("nodes", "array<vec4<u32>>"),
            Binding::read("leaves", "array<vec4<u32>>"),
            Binding::params("ExtendParams"),
            Binding::read("rays", "array<Ray>"),
            Binding::write("hits", "array<Hit>"),
        ],
        &texture_bindings(&["cutout"]),
    ]),
    makes: &[],
    twin: twin!(traverse::closest_hit),
};

/// Whether anything lies between the ends of every ray: 1 or 0.
pub static OCCLUDED: Pass = Pass {
    name: "occluded",
    module: "passes/trace/occluded",
    entry: "occluded",
    features: &[],
    bindings: &Binding::list::<9>(&[
        &[
            Binding::read("nodes", "array<vec4<u32>>"),
            Binding::read("leaves", "array<vec4<u32>>"),
            Binding::params("ExtendParams"),
            Binding::read("rays", "array<Ray>"),
            Binding::write("occlusion", "array<u32>"),
        ],
        &texture_bindings(&["cutout"]),
    ]),
    makes: &[],
    twin: twin!(traverse::any_hit),
};

/// Buffers for so many rays, both passes' results included.
pub fn buffers(rays: u32) -> Vec<(&'static str, u64)> {
    let rays = u64::from(rays.max(1));
    vec![("rays", rays * size_of::<Ray>() as u64), ("hits", rays * size_of::<Hit>() as u64), ("occlusion", rays * 4)]
}

/// Records the closest hits of the first `rays` rays in a tree over `triangles` triangles.
pub fn record(recording: &mut Recording, rays: u32, triangles: u32) {
    let params = ExtendParams { count: rays, root: (PLAN.root)(triangles) };
    recording.run(&EXTEND, Size::Items(u64::from(rays))).params(&params);
}

/// Records whether the first `rays` rays hit anything in a tree over `triangles` triangles.
pub fn record_occluded(recording: &mut Recording, rays: u32, triangles: u32) {
    let params = ExtendParams { count: rays, root: (PLAN.root)(triangles) };
    recording.run(&OCCLUDED, Size::Items(u64::from(rays))).params(&params);
}
