// Triangles in the order of their sorted codes, and the box of each: level 0 of the pyramid.

import package::gen::{BuildParams, LeafBox, SORT_IN_BACK, SortPlan, Triangle};
import package::lib::intersect::{padded_box};

@group(0) @binding(0) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(1) var<storage, read> sort_plan: SortPlan;
@group(0) @binding(2) var<storage, read> payload: array<u32>;
@group(0) @binding(3) var<storage, read> payload_back: array<u32>;
@group(0) @binding(4) var<storage, read_write> leaves: array<Triangle>;
@group(0) @binding(5) var<storage, read_write> boxes: array<LeafBox>;
@group(0) @binding(6) var<storage, read> params: BuildParams;

const GROUP_SIZE = 256u;

fn sorted_triangle(leaf: u32) -> u32 {
    if (sort_plan.result == SORT_IN_BACK) {
        return payload_back[leaf];
    }
    return payload[leaf];
}

@compute @workgroup_size(GROUP_SIZE)
fn gather_leaves(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let leaf = (workgroup.x + workgroup.y * workgroups.x) * GROUP_SIZE + lane;
    if (leaf >= params.count) {
        return;
    }
    let triangle = triangles[sorted_triangle(leaf)];
    leaves[leaf] = triangle;
    let own = padded_box(triangle.a, triangle.b, triangle.c);
    boxes[leaf] = LeafBox(vec4<f32>(own.low, 0.0), vec4<f32>(own.high, 0.0));
}
