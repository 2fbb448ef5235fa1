// The bits in which keys agree: the AND of keys in xy, the OR of keys in zw.

import package::gen::SORT_THREADS;

/// The agreement of no keys.
const NO_KEYS: vec4<u32> = vec4<u32>(0xffffffffu, 0xffffffffu, 0u, 0u);

/// The first of so many threads merge those that lie as many apart; then one merges these.
const MERGERS: u32 = 16u;

var<workgroup> agreements: array<vec4<u32>, SORT_THREADS>;

fn merge(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return vec4<u32>(a.xy & b.xy, a.zw | b.zw);
}

/// Merges the agreements of all threads of a workgroup; called by all of them, once. Only thread 0 has the result.
fn merge_over_workgroup(own: vec4<u32>, thread: u32) -> vec4<u32> {
    agreements[thread] = own;
    workgroupBarrier();
    var all = own;
    if thread < MERGERS {
        for (var i = thread + MERGERS; i < SORT_THREADS; i += MERGERS) {
            all = merge(all, agreements[i]);
        }
        agreements[thread] = all;
    }
    workgroupBarrier();
    if thread == 0u {
        for (var i = 1u; i < MERGERS; i++) {
            all = merge(all, agreements[i]);
        }
    }
    return all;
}
