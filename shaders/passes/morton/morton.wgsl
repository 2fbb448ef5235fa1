// 63-bit Morton codes of the triangles' centroids, with the triangle's index beside each.
//
// All axes share one scale, that of the longest: cells are cubes, so a split is always across a long side of its cell,
// and a thin axis spends no bits on slabs that are much thinner than wide. In a scene with something far beyond its core, the cells
// are the core's, and grow with the distance from there on: else all but that one thing would lie in one.
//
// Every operation here is exact or correctly rounded, and no product meets a sum: the CPU twin gives the same bits.

import package::gen::{BuildParams, CORE_CELLS, MORTON_BITS, OCTAVE_SHIFT, Triangle};
import package::lib::math::{largest_of};
import package::lib::ordered::{greatest_corner, least_corner};

@group(0) @binding(0) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(1) var<storage, read> centroid_bounds: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> keys: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read_write> payload: array<u32>;
@group(0) @binding(4) var<storage, read> params: BuildParams;

const GROUP_SIZE = 256u;

// Cells per metre: 2^MORTON_BITS / extent, rounded down by at most 2^-14 of itself. WGSL's division is not correctly
// rounded, that of integers is: the significand's upper 16 bits are divided, the exponent is subtracted.
// 0, one cell for all, for an extent that is below 2^-103 or not finite.
fn cells_per_metre(extent: f32) -> f32 {
    let bits = bitcast<u32>(extent);
    let exponent = bits >> 23u;
    if (exponent < 24u || exponent > 254u) {
        return 0.0;
    }
    let significand = 0x8000u + ((bits & 0x7fffffu) >> 8u) + 1u;
    let quotient = 0xffffffffu / significand;
    return f32(quotient) * bitcast<f32>((MORTON_BITS + 237u - exponent) << 23u);
}

// The cell of a scene that reaches beyond its core: numbered from the origin, half of them on either side; linear within the core
// (a product with a power of two), then by the bits of the float, so that each octave has as many.
fn cell_around_core(x: f32, core: f32) -> u32 {
    let distance = abs(x);
    let inside = u32(min(distance, core) * (f32(CORE_CELLS) / core));
    let outside = CORE_CELLS + ((bitcast<u32>(max(distance, core)) - bitcast<u32>(core)) >> OCTAVE_SHIFT);
    let number = select(inside, outside, distance > core);
    let middle = 1u << (MORTON_BITS - 1u);
    return select(middle + number, middle - 1u - number, x < 0.0);
}

// Bit i of the lower ten goes to bit 3i.
fn spread(bits: u32) -> u32 {
    var x = bits & 0x3ffu;
    x = (x | (x << 16u)) & 0x030000ffu;
    x = (x | (x << 8u)) & 0x0300f00fu;
    x = (x | (x << 4u)) & 0x030c30c3u;
    return (x | (x << 2u)) & 0x09249249u;
}

// Ten bits an axis, x uppermost in each triple.
fn interleave(cell: vec3<u32>) -> u32 {
    return (spread(cell.x) << 2u) | (spread(cell.y) << 1u) | spread(cell.z);
}

fn morton_code(cell: vec3<u32>) -> vec2<u32> {
    let low = interleave(cell);
    let middle = interleave(cell >> vec3<u32>(10u));
    let high = interleave(cell >> vec3<u32>(20u));
    return vec2<u32>(low | (middle << 30u), (middle >> 2u) | (high << 28u));
}

@compute @workgroup_size(GROUP_SIZE)
fn morton(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let index = (workgroup.x + workgroup.y * workgroups.x) * GROUP_SIZE + lane;
    if (index >= params.count) {
        return;
    }
    let least = least_corner(centroid_bounds[0].xyz);
    let greatest = greatest_corner(centroid_bounds[1].xyz);
    let scale = cells_per_metre(largest_of(greatest - least));

    let triangle = triangles[index];
    let low = min(min(triangle.a, triangle.b), triangle.c);
    let high = max(max(triangle.a, triangle.b), triangle.c);
    let centroid = (low + high) * 0.5;
    let last_cell = f32((1u << MORTON_BITS) - 1u);
    var cell = vec3<u32>(clamp((centroid - least) * scale, vec3<f32>(0.0), vec3<f32>(last_cell)));
    if (largest_of(max(-least, greatest)) > params.core) {
        cell = vec3<u32>(
            cell_around_core(centroid.x, params.core),
            cell_around_core(centroid.y, params.core),
            cell_around_core(centroid.z, params.core),
        );
    }
    keys[index] = morton_code(cell);
    payload[index] = index;
}
