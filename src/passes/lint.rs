//! A surface's code, evaluated for the linter: what it draws, and what it returns for given directions.

use super::twin::twin;
use super::{Binding, Pass, Recording, Size};
use crate::layout::lint::{LintAnswer, LintParams};

/// `mixture_sample` and `mixture_evaluate` of the scene's own features.
pub static LINT: Pass = Pass {
    name: "lint",
    module: "passes/lint/surface",
    entry: "surface",
    features: &[],
    bindings: &[
        Binding::params("LintParams"),
        Binding::read("lint_cases", "array<LintCase>"),
        Binding::read("lint_directions", "array<vec4<f32>>"),
        Binding::write("lint_answers", "array<LintAnswer>"),
    ],
    makes: &[],
    twin: twin!(bsdf::Reflection::evaluate),
};

/// Buffers for so many answers, beside `lint_cases`.
pub fn buffers(answers: u32) -> Vec<(&'static str, u64)> {
    let answers = u64::from(answers.max(1));
    vec![("lint_directions", answers * 16), ("lint_answers", answers * size_of::<LintAnswer>() as u64)]
}

/// Records as many answers as `params` says.
pub fn record(recording: &mut Recording, params: &LintParams) {
    recording.run(&LINT, Size::Items(u64::from(params.count))).params(params);
}
