// The bits in which keys agree: the AND of keys in xy, the OR of keys in zw.

import package::gen::SORT_THREADS;

/// The agreement of no keys.
const NO_KEYS: vec4<u32> = vec4<u32>(0xffffffffu, 0xffffffffu, 0u, 0u);

var<workgroup> agreements: array<vec4<u32>, SORT_THREADS>;

fn merge(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return vec4<u32>(a.xy & b.xy, a.zw | b.zw);
}

/// Merges the agreements of all threads of a workgroup; called by all of them, once.
fn merge_over_workgroup(own: vec4<u32>, thread: u32) -> vec4<u32> {
    agreements[thread] = own;
    workgroupBarrier();
    for (var half = SORT_THREADS / 2u; half > 0u; half >>= 1u) {
        if thread < half {
            agreements[thread] = merge(agreements[thread], agreements[thread + half]);
        }
        workgroupBarrier();
    }
    return agreements[0];
}
