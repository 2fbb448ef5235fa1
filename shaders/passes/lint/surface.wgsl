// Evaluates a surface for the linter on the CPU: draws of mixture_sample() with what mixture_evaluate() returns for them, or what it
// returns for directions that the linter has chosen.

import package::gen::{LintAnswer, LintCase, LintParams, SampleKey};
import package::lib::bsdf::frame::{BsdfSample, ShadingFrame};
import package::lib::bsdf::mixture::{mixture_evaluate, mixture_sample};
@if(reuse && (ggx || phong || coat)) import package::lib::bsdf::mixture::{mixture_seen_from_anywhere};
@if(reuse) import package::lib::math::{largest_of};
import package::lib::rng::{sample_1d, sample_2d};

@group(0) @binding(0) var<storage, read> params: LintParams;
@group(0) @binding(1) var<storage, read> lint_cases: array<LintCase>;
@group(0) @binding(2) var<storage, read> lint_directions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> lint_answers: array<LintAnswer>;

// What a path that is reused lends of a surface's value (passes/trace/reuse).
@if(reuse)
fn lent_value(surface: LintCase, frame: ShadingFrame, wi: vec3<f32>) -> vec3<f32> {
    @if(ggx || phong || coat) {
        return mixture_seen_from_anywhere(surface.material, frame, wi);
    } @else {
        return mixture_evaluate(surface.material, frame, wi).value;
    }
}

// By which part that differs where the surface is seen from straight above instead.
@if(reuse)
fn change_with_view(surface: LintCase, frame: ShadingFrame, wi: vec3<f32>) -> f32 {
    let value = lent_value(surface, frame, wi);
    let other = lent_value(surface, ShadingFrame(frame.shading, frame.shading, frame.geometric, frame.back_face), wi);
    return largest_of(abs(value - other)) / max(largest_of(max(value, other)), 0x1p-100);
}

@compute @workgroup_size(64)
fn surface(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let i = (group.x + group.y * groups.x) * 64u + local;
    if (i >= params.count) {
        return;
    }
    let surface = lint_cases[i / params.per_case];
    let frame = ShadingFrame(surface.wo, surface.normal, surface.normal, 0u);
    var drawn = BsdfSample(lint_directions[i].xyz, 0.0, vec3<f32>(0.0));
    if (params.draw != 0u) {
        let key = SampleKey(i, 0u, 0u, params.seed);
        drawn = mixture_sample(surface.material, frame, sample_1d(key, 0u), sample_2d(key, 1u));
    }
    let at = mixture_evaluate(surface.material, frame, drawn.direction);
    var change = 0.0;
    @if(reuse) {
        change = change_with_view(surface, frame, drawn.direction);
    }
    lint_answers[i] = LintAnswer(drawn.direction, drawn.pdf, drawn.weight, at.pdf, at.value, change);
}
