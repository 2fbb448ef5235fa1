//! A path that is replayed: what is kept of each of its rays.

use glam::{Vec2, Vec3};

gpu_struct! {
    /// A ray of a path, and what came of it. World space relative to the scene's origin; radiance is linear Rec.709.
    pub struct PathTurn {
        pub origin: Vec3,
        /// A `RAY_` kind.
        pub kind: u32,
        /// Unit length.
        pub direction: Vec3,
        /// Path segments before the ray: of a shadow ray, those up to its surface and one more where the path goes on from there.
        pub bounce: u32,
        /// What a unit of radiance along the ray adds to the pixel; of a shadow ray, what its light adds if it is seen.
        pub throughput: Vec3,
        /// Where the ray ends; its farthest if nothing was hit.
        pub t: f32,
        /// What a unit of radiance along the ray adds to what the path lends; 0 where paths are not reused.
        pub lent: Vec3,
        /// Density by solid angle with which the direction was drawn; 0 where it could have been no other.
        pub pdf: f32,
        /// What was hit: its index in scene order, or `NO_HIT`.
        pub triangle: u32,
        /// Index of its material, or `NO_MATERIAL`.
        pub material: u32,
        /// Weight of the second corner.
        pub b1: f32,
        /// Weight of the third corner.
        pub b2: f32,
        /// The point of the surface.
        pub position: Vec3,
        /// `TURN_` flags: which of the following is there.
        pub done: u32,
        /// Normal of the triangle on the side of the viewer, unit length.
        pub geometric: Vec3,
        /// 1: seen from its back, by its winding.
        pub back_face: u32,
        /// The normal that the surface is shaded by, unit length.
        pub shading: Vec3,
        /// 0, or what `PathState::fault` says.
        pub fault: u32,
        /// Radiance that arrives along the ray from its end.
        pub emitted: Vec3,
        /// Density with which light sampling draws the ray's direction; 0 where it can't.
        pub found_pdf: f32,
        /// What the pixel got of the ray.
        pub added: Vec3,
        /// Density of the direction that was drawn; 0 where its lobe has no other.
        pub drawn_pdf: f32,
        /// The direction that the surface drew, unit length.
        pub drawn_direction: Vec3,
        /// Probability with which the path outlives roulette; 1 where that is not played.
        pub survival: f32,
        /// f * cos by the density, or a single direction's value by its probability.
        pub drawn_weight: Vec3,
        /// Density with which the surface draws the direction of the light.
        pub light_bsdf_pdf: f32,
        /// Towards the light that was sampled, unit length.
        pub light_direction: Vec3,
        /// With which that direction was drawn.
        pub light_pdf: f32,
        /// What the light sends.
        pub light_radiance: Vec3,
        /// What it counts for beside finding it by chance; 0 where nothing of it is sent on.
        pub light_weight: f32,
        /// f * cos of its direction.
        pub light_value: Vec3,
        /// Its triangle, or `NO_HIT`.
        pub light_triangle: u32,
        /// All that the pixel has so far; where a number went wrong, that.
        pub radiance: Vec3,
        pub pad0: u32,
        /// Random numbers: which lobe, and whether the path survives.
        pub choices: Vec2,
        /// And which light, with the point on it.
        pub light_u: Vec2,
        /// And the direction.
        pub drawn_u: Vec2,
        pub pad1: Vec2,
    }

    /// What a path that is replayed comes to.
    pub struct Replayed {
        /// As `RadianceSample` has it.
        pub rgb: Vec3,
        pub info: u32,
        /// Rays, those included that there was no room to keep.
        pub turns: u32,
        /// Numbers that code has shown of itself, and how many of them there was room to keep.
        pub probed: u32,
        pub probed_kept: u32,
        pub pad2: u32,
    }
}

gpu_consts! {
    /// A segment of the path.
    pub const RAY_SEGMENT: u32 = 0;
    /// A ray to a light that was sampled.
    pub const RAY_SHADOW: u32 = 1;
    /// The path went through a surface at the end of the ray: position and normals.
    pub const TURN_SURFACE: u32 = 1;
    /// A light was sampled there.
    pub const TURN_LIGHT: u32 = 2;
    /// A direction was drawn there.
    pub const TURN_DRAWN: u32 = 4;
    /// The path goes on in that direction.
    pub const TURN_GOES_ON: u32 = 8;
    /// Rays of a path that are kept.
    pub const MOST_TURNS: u32 = 4096;
}
