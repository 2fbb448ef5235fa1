// A surface asked by itself: what is drawn of it, and what it says of a direction.

import package::gen::{BsdfProbe, SampleKey};
import package::lib::bsdf::frame::{BsdfSample, ShadingFrame};
import package::lib::bsdf::mixture::{mixture_evaluate, mixture_sample};
@if(dielectric) import package::lib::bsdf::dielectric::{fresnel, interface_of};
import package::lib::math::{expm1_negative, log1p_negative, sin_cos_turns};
import package::lib::rng::{sample_1d, sample_2d};

@group(0) @binding(0) var<storage, read> params: BsdfProbe;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

fn frame() -> ShadingFrame {
    return ShadingFrame(params.wo, params.normal, params.geometric, params.back_face);
}

@compute @workgroup_size(64)
fn draw(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let key = SampleKey(i, 0u, 0u, params.seed);
    let drawn = mixture_sample(params.material, frame(), sample_1d(key, 0u), sample_2d(key, 1u));
    let at = mixture_evaluate(params.material, frame(), drawn.direction);
    probed[3u * i] = vec4<f32>(drawn.direction, drawn.pdf);
    probed[3u * i + 1u] = vec4<f32>(drawn.weight, at.pdf);
    probed[3u * i + 2u] = vec4<f32>(at.value, 0.0);
}

// Mean weight of one lobe's draws over a row of the unit square. Finer towards u.x = 1, where all lobes have their tails: by
// 1 - s^2, which weighs 2 s.
@compute @workgroup_size(64)
fn albedo(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    var sum = vec3<f32>(0.0);
    for (var j = 0u; j < params.count; j++) {
        let at = (vec2<f32>(vec2<u32>(i, j)) + 0.5) / f32(params.count);
        let u = vec2<f32>(1.0 - at.y * at.y, at.x);
        sum += 2.0 * at.y * mixture_sample(params.material, frame(), params.pick, u).weight;
    }
    probed[i] = vec4<f32>(sum / f32(params.count), 0.0);
}

@compute @workgroup_size(64)
fn elementary(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let x = probed[i].x;
    probed[i] = vec4<f32>(log1p_negative(-x), expm1_negative(-x * 20.0), sin_cos_turns(x));
}

// Cosines in, reflectances and cosines beyond out.
@compute @workgroup_size(64)
fn split(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    @if(dielectric) {
        let at = fresnel(interface_of(params.material.ni, params.back_face != 0u), probed[i].x);
        probed[i] = vec4<f32>(at.reflectance, at.cos_transmitted, 0.0, 0.0);
    }
}
