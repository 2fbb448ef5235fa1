// Boxes over aligned runs of 2^k leaves, PYRAMID_LEVELS levels a dispatch.
//
// Level k has floor(n / 2^k) boxes, since a query never needs a run that is cut off by the end, and the levels lie
// one behind the other. A workgroup reads 2 GROUP_SIZE boxes of the source level and writes all that lies above them.

import package::gen::{LeafBox, PYRAMID_LEVELS, PyramidParams};

@group(0) @binding(0) var<storage, read_write> boxes: array<LeafBox>;
@group(0) @binding(1) var<storage, read> params: PyramidParams;

// 2^(PYRAMID_LEVELS - 1), so that the last level is one box a workgroup.
const GROUP_SIZE = 1u << (PYRAMID_LEVELS - 1u);

// The box of run r of level k of this workgroup is in slot r * 2^k.
var<workgroup> slots: array<LeafBox, GROUP_SIZE>;

fn joined(a: LeafBox, b: LeafBox) -> LeafBox {
    return LeafBox(min(a.low, b.low), max(a.high, b.high));
}

@compute @workgroup_size(GROUP_SIZE)
fn build_levels(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let group = workgroup.x + workgroup.y * workgroups.x;
    var level_start = params.source + params.count;
    var level_count = params.count >> 1u;
    var group_runs = GROUP_SIZE;
    let first = group * GROUP_SIZE + lane;
    if (first < level_count) {
        let below = params.source + 2u * first;
        let both = joined(boxes[below], boxes[below + 1u]);
        boxes[level_start + first] = both;
        slots[lane] = both;
    }
    for (var level = 1u; level < PYRAMID_LEVELS; level++) {
        level_start += level_count;
        level_count >>= 1u;
        group_runs >>= 1u;
        let run = group * group_runs + lane;
        workgroupBarrier();
        if (lane < group_runs && run < level_count) {
            let left = lane << level;
            let both = joined(slots[left], slots[left + (1u << (level - 1u))]);
            boxes[level_start + run] = both;
            slots[left] = both;
        }
    }
}
