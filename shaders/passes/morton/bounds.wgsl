// The box of all triangles and the box of their centroids: a reduction in each workgroup, then one atomic a word.

import package::gen::{BOUNDS_PER_THREAD, BuildParams, CENTROID_HIGH, CENTROID_LOW, SCENE_HIGH, SCENE_LOW, Triangle};
import package::lib::ordered::ordered_bits;

@group(0) @binding(0) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(1) var<storage, read_write> centroid_bounds: array<atomic<u32>>;
@group(0) @binding(2) var<storage, read> params: BuildParams;

const GROUP_SIZE = 256u;

struct Extents {
    centroid_low: vec3<f32>,
    centroid_high: vec3<f32>,
    low: vec3<f32>,
    high: vec3<f32>,
}

var<workgroup> partial: array<Extents, GROUP_SIZE>;

fn joined(a: Extents, b: Extents) -> Extents {
    return Extents(
        min(a.centroid_low, b.centroid_low),
        max(a.centroid_high, b.centroid_high),
        min(a.low, b.low),
        max(a.high, b.high),
    );
}

// The centroid is that of the box, as in the Morton pass.
fn extents_of(triangle: Triangle) -> Extents {
    let low = min(min(triangle.a, triangle.b), triangle.c);
    let high = max(max(triangle.a, triangle.b), triangle.c);
    let centroid = (low + high) * 0.5;
    return Extents(centroid, centroid, low, high);
}

fn publish_low(first: u32, corner: vec3<f32>) {
    atomicMax(&centroid_bounds[first], ~ordered_bits(corner.x));
    atomicMax(&centroid_bounds[first + 1u], ~ordered_bits(corner.y));
    atomicMax(&centroid_bounds[first + 2u], ~ordered_bits(corner.z));
}

fn publish_high(first: u32, corner: vec3<f32>) {
    atomicMax(&centroid_bounds[first], ordered_bits(corner.x));
    atomicMax(&centroid_bounds[first + 1u], ordered_bits(corner.y));
    atomicMax(&centroid_bounds[first + 2u], ordered_bits(corner.z));
}

@compute @workgroup_size(GROUP_SIZE)
fn bounds(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let group = workgroup.x + workgroup.y * workgroups.x;
    let first = group * GROUP_SIZE * BOUNDS_PER_THREAD;
    if (first >= params.count) {
        return;
    }
    // A lane past the end repeats the group's first triangle, which changes no minimum and no maximum.
    var mine = extents_of(triangles[first]);
    for (var item = 0u; item < BOUNDS_PER_THREAD; item++) {
        let index = first + item * GROUP_SIZE + lane;
        if (index < params.count) {
            mine = joined(mine, extents_of(triangles[index]));
        }
    }
    partial[lane] = mine;
    for (var stride = GROUP_SIZE / 2u; stride > 0u; stride >>= 1u) {
        workgroupBarrier();
        if (lane < stride) {
            partial[lane] = joined(partial[lane], partial[lane + stride]);
        }
    }
    if (lane == 0u) {
        let all = partial[0];
        publish_low(CENTROID_LOW, all.centroid_low);
        publish_high(CENTROID_HIGH, all.centroid_high);
        publish_low(SCENE_LOW, all.low);
        publish_high(SCENE_HIGH, all.high);
    }
}
