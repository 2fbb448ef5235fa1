//! Rays and what they hit. World space relative to the scene's origin, as the triangles are.

use glam::Vec3;

gpu_consts! {
    /// `Hit::triangle` of a ray that hit nothing.
    pub const NO_HIT: u32 = 0xffff_ffff;
    /// The end of a ray that has none: finite, since WGSL may assume that no infinity exists.
    pub const T_FAR: f32 = 3.0e38;
    /// Steps after which a query gives up. A valid tree of `n` leaves needs fewer than `3 n`; `Hit::steps` reaching
    /// this means that the tree is not one.
    pub const MAX_STEPS: u32 = 0x1000_0000;
    /// What boxes grow by on every side: this part of the triangle's greatest coordinate, and of the ray's origin's. A triangle that
    /// passes the edge test lies within 8 * 2^-24 * distance of the ray: the roundings of each sheared coordinate and of the shear.
    /// Twice that leaves the roundings of the slabs themselves. Each box by its own coordinates, not all by the scene's: one thing
    /// far away then costs the rest nothing.
    pub const SLAB_GROWTH: f32 = 1.0 / 1048576.0;
    /// Far planes move out by this factor, for the rounding of the reciprocal and the last one (Ize 2013).
    pub const FAR_GROWTH: f32 = 1.0 + 1.0 / 1048576.0;
    /// A direction's component counts as at least this part of the largest: its reciprocal stays finite.
    pub const LEAST_PART: f32 = 1.0 / (1u64 << 60) as f32;
    /// Twice the area below which a sheared triangle counts as edge-on, so that its reciprocal stays finite.
    pub const LEAST_AREA: f32 = 1.0 / (1u128 << 120) as f32;
    /// How many times its error a point keeps away from the edges of its triangle.
    pub const INSET: f32 = 16.0;
}

gpu_struct! {
    /// The points `origin + t * direction` with `t_min < t <= t_max`.
    ///
    /// The direction need not be of unit length, but its largest component is within 2^-20 and 2^20; coordinates stay
    /// below 2^40. A ray without direction hits nothing.
    pub struct Ray {
        /// Where t is 0.
        pub origin: Vec3,
        /// Not negative.
        pub t_min: f32,
        /// Where t grows; zeros of either sign are fine.
        pub direction: Vec3,
        /// At most [`T_FAR`].
        pub t_max: f32,
    }

    /// The hit of least (t as computed, index of the triangle), whatever the tree.
    pub struct Hit {
        /// In units of the direction's length; the ray's `t_max` if nothing was hit.
        pub t: f32,
        /// Index in scene order, or [`NO_HIT`].
        pub triangle: u32,
        /// Index in `leaves`; 0 if nothing was hit.
        pub leaf: u32,
        /// Barycentric weight of the triangle's second corner, 0 to 1.
        pub b1: f32,
        /// Barycentric weight of the triangle's third corner, 0 to 1.
        pub b2: f32,
        /// Nodes visited, those on the way back up included.
        pub steps: u32,
    }

    /// Parameters of the passes that trace a buffer of rays.
    pub struct ExtendParams {
        /// Number of rays.
        pub count: u32,
        /// What `tree::root` says of the number of triangles.
        pub root: u32,
    }
}
