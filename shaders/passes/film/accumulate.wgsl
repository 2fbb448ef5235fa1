// Adds a batch of samples to the film in 64-bit fixed point: exact and associative, so that no cutting of the samples
// into batches changes a bit. A bad sample is counted and logged, and is in neither the sums nor the divisor.

import package::gen::{AccumulateParams, BadSample, FilmCounters, FilmHalf, FilmPixel, RadianceSample};
import package::gen::{BAD_LOG, BAD_OVERFLOW, NO_MATERIAL, SAMPLE_BAD, UNKNOWN_BOUNCE};
import package::lib::fixed::{add_u64, fixed_point};
import package::lib::fault::{fault_of};

@group(0) @binding(0) var<storage, read> params: AccumulateParams;
@group(0) @binding(1) var<storage, read> radiance: array<RadianceSample>;
@group(0) @binding(2) var<storage, read_write> film: array<FilmPixel>;
@group(0) @binding(3) var<storage, read_write> counters: FilmCounters;

var<workgroup> group_rays: atomic<u32>;

// Where a pixel of the batch is, from its first one.
fn place_of(pixel: u32) -> vec2<u32> {
    return vec2<u32>(pixel % params.window_width, pixel / params.window_width) << vec2<u32>(params.column_shift, params.row_shift);
}

fn log_bad(pixel: u32, sample: u32, bounce: u32, material: u32, kind: u32) {
    let slot = atomicAdd(&counters.bad, 1u);
    if (slot < BAD_LOG) {
        let at = place_of(pixel) + vec2<u32>(params.window_x, params.window_y);
        counters.log[slot] = BadSample(at.y * params.film_width + at.x, sample, bounce, material, kind);
    }
}

// Adds `value` to `half` unless something is wrong with it; returns what, a `BAD_` kind or 0.
fn add_sample(half: ptr<function, FilmHalf>, value: vec3<f32>) -> u32 {
    let kind = fault_of(value);
    if (kind != 0u) {
        return kind;
    }
    var sums: array<vec2<u32>, 3>;
    for (var c = 0u; c < 3u; c++) {
        let addend = fixed_point(value[c], params.exponent);
        let sum = add_u64((*half).sum[c], addend.words);
        if (addend.too_large || sum.too_large) {
            return BAD_OVERFLOW;
        }
        sums[c] = sum.words;
    }
    (*half).sum = sums;
    (*half).count += 1u;
    return 0u;
}

// Adds one sample of `pixel`, whichever way it turned out.
fn add_or_log(half: ptr<function, FilmHalf>, arrived: RadianceSample, pixel: u32, sample: u32) {
    if ((arrived.info & SAMPLE_BAD) != 0u) {
        log_bad(pixel, sample, u32(arrived.rgb.y), u32(arrived.rgb.z), u32(arrived.rgb.x));
        (*half).bad += 1u;
        return;
    }
    let kind = add_sample(half, arrived.rgb);
    if (kind != 0u) {
        log_bad(pixel, sample, UNKNOWN_BOUNCE, NO_MATERIAL, kind);
        (*half).bad += 1u;
    }
}

// The samples of one pixel, layer by layer; returns how many rays were traced for them.
fn add_layers(pixel: u32) -> u32 {
    let first = params.radiance_first + pixel / params.window_width * params.radiance_row + pixel % params.window_width;
    let place = place_of(pixel);
    let index = params.first_pixel + place.y * params.row + place.x;
    var rays = 0u;
    for (var half = 0u; half < 2u; half++) {
        var sums: FilmHalf;
        if (params.replaces == 0u) {
            sums = film[index].halves[half];
        }
        for (var layer = (params.first_sample + half) & 1u; layer < params.layers; layer += 2u) {
            let arrived = radiance[layer * params.radiance_layer + first];
            rays += arrived.info & ~SAMPLE_BAD;
            add_or_log(&sums, arrived, pixel, params.first_sample + layer);
        }
        film[index].halves[half] = sums;
    }
    return rays;
}

@compute @workgroup_size(64)
fn accumulate(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    if (local == 0u) {
        atomicStore(&group_rays, 0u);
    }
    workgroupBarrier();
    let pixel = (group.x + group.y * groups.x) * 64u + local;
    if (pixel < params.window_width * params.window_height) {
        atomicAdd(&group_rays, add_layers(pixel));
    }
    workgroupBarrier();
    if (local == 0u) {
        let rays = atomicLoad(&group_rays);
        let before = atomicAdd(&counters.rays_lo, rays);
        if (before + rays < before) {
            atomicAdd(&counters.rays_hi, 1u);
        }
    }
}
