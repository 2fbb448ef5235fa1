// Exclusive prefix sums over the threads of a workgroup, two counters at once.

import package::gen::SORT_THREADS;

/// Threads of a group, and groups of a workgroup. Two levels of plain sums take three barriers; steps that double, nine.
const GROUP: u32 = 16u;
const GROUPS: u32 = SORT_THREADS / GROUP;

var<workgroup> prefix_values: array<vec2<u32>, SORT_THREADS>;
var<workgroup> prefix_groups: array<vec2<u32>, GROUPS>;

struct Prefix {
    /// Sum over the threads below this one.
    before: vec2<u32>,
    /// Sum over all threads.
    total: vec2<u32>,
}

/// Called by all threads of a workgroup. It starts and ends so that it may be called again at once.
fn prefix_over_workgroup(own: vec2<u32>, thread: u32) -> Prefix {
    let lane = thread % GROUP;
    let group = thread / GROUP;
    prefix_values[thread] = own;
    workgroupBarrier();
    var before = vec2<u32>(0u);
    for (var i = 0u; i < GROUP - 1u; i++) {
        let value = prefix_values[group * GROUP + i];
        before += select(vec2<u32>(0u), value, i < lane);
    }
    if lane == GROUP - 1u {
        prefix_groups[group] = before + own;
    }
    workgroupBarrier();
    var total = vec2<u32>(0u);
    for (var i = 0u; i < GROUPS; i++) {
        let value = prefix_groups[i];
        before += select(vec2<u32>(0u), value, i < group);
        total += value;
    }
    workgroupBarrier();
    return Prefix(before, total);
}
