// What half of a tile tells of its variance: of each pixel the mean of its first 2 k samples is compared with that of its first k, which was noted
// when there were no more. So two batches of samples tell the error of their mean, however they depend on each other within. One half of one tile a
// workgroup, one pixel an invocation.

import package::gen::{FilmHalf, FilmPixel, PixelMark, TallyParams, TallyRun, TileTally};
import package::gen::{MOST_OF_TILE, MOST_TALLIED, TALLY_DARK, TILE_LANES};
import package::lib::tiles::{place_in_tile, tile_corner};

@group(0) @binding(0) var<storage, read> params: TallyParams;
@group(0) @binding(1) var<storage, read> tally_runs: array<TallyRun>;
@group(0) @binding(2) var<storage, read> film: array<FilmPixel>;
@group(0) @binding(3) var<storage, read_write> marks: array<PixelMark>;
@group(0) @binding(4) var<storage, read_write> tallies: array<TileTally>;

var<workgroup> terms: array<vec4<f32>, TILE_LANES>;

// The sum of what all lanes give. In one order, so that it is the same each time.
fn sum_of_tile(term: vec4<f32>, lane: u32) -> vec4<f32> {
    terms[lane] = term;
    workgroupBarrier();
    for (var reach = TILE_LANES / 2u; reach > 0u; reach /= 2u) {
        if (lane < reach) {
            terms[lane] += terms[lane + reach];
        }
        workgroupBarrier();
    }
    let sum = terms[0];
    workgroupBarrier();
    return sum;
}

// Mean radiance; black without samples.
fn mean_of(half: FilmHalf) -> vec3<f32> {
    var mean: vec3<f32>;
    for (var c = 0u; c < 3u; c++) {
        mean[c] = f32(half.sum[c].y) * 0x1p32 + f32(half.sum[c].x);
    }
    return min(mean * (params.scale / f32(max(half.count, 1u))), vec3<f32>(MOST_TALLIED));
}

@compute @workgroup_size(64)
fn tally(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let index = group.x + group.y * groups.x;
    let run = tally_runs[min(index, params.runs - 1u)];
    let half = run.half;
    let place = tile_corner(run.tile) + place_in_tile(lane) - vec2<u32>(params.window_x, params.window_y);
    var mean = vec4<f32>(0.0);
    var off = vec3<f32>(0.0);
    var rays = 0.0;
    // What is left of the window, or above it, is beyond its other end.
    if (index < params.runs && all(place < vec2<u32>(params.window_width, params.window_height))) {
        let pixel = place.y * params.window_width + place.x;
        mean = vec4<f32>(mean_of(film[pixel].halves[half]), 1.0);
        off = mean.xyz - marks[pixel].halves[half].mean;
        rays = f32(marks[pixel].halves[half].rays);
        marks[pixel].halves[half].mean = mean.xyz;
    }
    let means = sum_of_tile(mean, lane);
    let pixels = max(means.w, 1.0);
    let radiance = means.xyz / pixels;
    let error = dot(off * off, 1.0 / (radiance * radiance + TALLY_DARK));
    let sums = sum_of_tile(vec4<f32>(error, rays, 0.0, 0.0), lane);
    let most = MOST_OF_TILE * sums.x / pixels;
    let bounded = sum_of_tile(vec4<f32>(min(error, most), 0.0, 0.0, 0.0), lane);
    if (lane == 0u && index < params.runs) {
        tallies[index] = TileTally(means.xyz, means.w, bounded.x, sums.y, 0u, 0u);
    }
}
