//! What the linter evaluates of a surface, and the results.

use glam::Vec3;

use super::trace::MaterialRecord;

gpu_struct! {
    /// A surface as it is seen.
    pub struct LintCase {
        pub material: MaterialRecord,
        /// Away from the surface, to where the ray came from. Unit length, on the side of `normal`.
        pub wo: Vec3,
        pub pad0: u32,
        /// Shading and geometric normal, unit length.
        pub normal: Vec3,
        pub pad1: u32,
    }

    /// One draw, or one given direction.
    pub struct LintAnswer {
        pub direction: Vec3,
        /// What `mixture_sample` says of it; 0 of a given direction.
        pub pdf: f32,
        /// The same of the weight.
        pub weight: Vec3,
        /// The pdf by `mixture_evaluate`.
        pub evaluated: f32,
        /// f * cos by `mixture_evaluate`.
        pub value: Vec3,
        /// Where paths are reused: by which part what they lend in this direction is other, seen from straight above.
        pub change_with_view: f32,
    }

    /// Parameters of the pass.
    pub struct LintParams {
        /// Answers of all cases.
        pub count: u32,
        /// Answers of each case.
        pub per_case: u32,
        pub seed: u32,
        /// 1: directions are drawn; 0: they are those in `lint_directions`.
        pub draw: u32,
    }
}
