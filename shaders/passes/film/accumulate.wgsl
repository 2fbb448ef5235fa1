// Adds a batch of samples to the film in 64-bit fixed point: exact and associative, so that no cutting of the samples
// into batches changes a bit. A bad sample is counted and logged, and is in neither the sums nor the divisor. A half that is full
// takes no more, whatever comes: one that took what still fits would have lost the bright ones alone.

import package::gen::{AccumulateParams, BadSample, FilmCounters, FilmHalf, FilmPixel, RadianceSample};
@if(adaptive) import package::gen::{PixelMark, TileRun, TileSample, TILE_LANES};
import package::gen::{BAD_LOG, BAD_OVERFLOW, FULL_SUM, NO_MATERIAL, SAMPLE_BAD, UNKNOWN_BOUNCE};
import package::lib::fixed::{add_u64, fixed_point};
import package::lib::fault::{fault_of};
@if(adaptive) import package::lib::tiles::{place_in_tile, tile_corner};

@group(0) @binding(0) var<storage, read> params: AccumulateParams;
@group(0) @binding(1) var<storage, read> radiance: array<RadianceSample>;
@group(0) @binding(2) var<storage, read_write> film: array<FilmPixel>;
@group(0) @binding(3) var<storage, read_write> counters: FilmCounters;
@if(adaptive) @group(0) @binding(4) var<storage, read> tile_samples: array<TileSample>;
@if(adaptive) @group(0) @binding(5) var<storage, read> tile_runs: array<TileRun>;
@if(adaptive) @group(0) @binding(6) var<storage, read_write> marks: array<PixelMark>;

var<workgroup> group_rays: atomic<u32>;

// Where a pixel of the batch is, from its first one.
fn place_of(pixel: u32) -> vec2<u32> {
    return vec2<u32>(pixel % params.window_width, pixel / params.window_width) << vec2<u32>(params.column_shift, params.row_shift);
}

// `at` is a pixel of the whole film.
fn log_bad(at: vec2<u32>, sample: u32, bounce: u32, material: u32, kind: u32) {
    let slot = atomicAdd(&counters.bad, 1u);
    if (slot < BAD_LOG) {
        counters.log[slot] = BadSample(at.y * params.film_width + at.x, sample, bounce, material, kind);
    }
}

// Whether a half takes no more: another sample might not fit its sums.
fn is_full(half: ptr<function, FilmHalf>) -> bool {
    return max((*half).sum[0].y, max((*half).sum[1].y, (*half).sum[2].y)) >= FULL_SUM;
}

// Adds `value` to `half`, which is not full, unless something is wrong with it; returns what, a `BAD_` kind or 0.
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

// Adds one sample of the pixel `at`, whichever way it turned out.
fn add_or_log(half: ptr<function, FilmHalf>, arrived: RadianceSample, at: vec2<u32>, sample: u32) {
    if ((arrived.info & SAMPLE_BAD) != 0u) {
        log_bad(at, sample, u32(arrived.rgb.y), u32(arrived.rgb.z), u32(arrived.rgb.x));
        (*half).bad += 1u;
        return;
    }
    if (is_full(half)) {
        return;
    }
    let kind = add_sample(half, arrived.rgb);
    if (kind != 0u) {
        log_bad(at, sample, UNKNOWN_BOUNCE, NO_MATERIAL, kind);
        (*half).bad += 1u;
    } else if (is_full(half)) {
        atomicAdd(&counters.full, 1u);
    }
}

// The samples of one pixel, layer by layer; returns how many rays were traced for them.
fn add_layers(pixel: u32) -> u32 {
    let first = params.radiance_first + pixel / params.window_width * params.radiance_row + pixel % params.window_width;
    let place = place_of(pixel);
    let index = params.first_pixel + place.y * params.row + place.x;
    let at = place + vec2<u32>(params.window_x, params.window_y);
    var rays = 0u;
    for (var half = 0u; half < 2u; half++) {
        var sums: FilmHalf;
        if (params.replaces == 0u) {
            sums = film[index].halves[half];
        }
        @if(adaptive) let before = rays;
        for (var layer = (params.first_sample + half) & 1u; layer < params.layers; layer += 2u) {
            let arrived = radiance[layer * params.radiance_layer + first];
            rays += arrived.info & ~SAMPLE_BAD;
            add_or_log(&sums, arrived, at, params.first_sample + layer);
        }
        film[index].halves[half] = sums;
        @if(adaptive) {
            marks[index].halves[half].rays = select(marks[index].halves[half].rays, 0u, params.replaces != 0u) + rays - before;
        }
    }
    return rays;
}

// The same, if there is such a pixel; counts its rays.
fn add_pixel(pixel: u32) {
    if (pixel < params.window_width * params.window_height) {
        atomicAdd(&group_rays, add_layers(pixel));
    }
}

// The samples of one pixel of a tile; returns how many rays were traced for them.
@if(adaptive)
fn add_run(run: TileRun, lane: u32) -> u32 {
    let at = tile_corner(run.tile) + place_in_tile(lane);
    let place = at - vec2<u32>(params.window_x, params.window_y);
    // What is left of the window, or above it, is beyond its other end.
    if (any(place >= vec2<u32>(params.window_width, params.window_height))) {
        return 0u;
    }
    let index = place.y * params.row + place.x;
    var number = run.first;
    var rays = 0u;
    for (var half = 0u; half < 2u; half++) {
        var sums = film[index].halves[half];
        let before = rays;
        for (let end = number + run.counts[half]; number < end; number++) {
            let arrived = radiance[number * TILE_LANES + lane];
            rays += arrived.info & ~SAMPLE_BAD;
            add_or_log(&sums, arrived, at, tile_samples[number].sample);
        }
        film[index].halves[half] = sums;
        marks[index].halves[half].rays += rays - before;
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
    @if(adaptive) {
        let run = group.x + group.y * groups.x;
        if (params.runs == 0u) {
            add_pixel(pixel);
        } else if (run < params.runs) {
            atomicAdd(&group_rays, add_run(tile_runs[run], local));
        }
    } @else {
        add_pixel(pixel);
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
