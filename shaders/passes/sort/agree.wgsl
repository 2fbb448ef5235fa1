// The bits in which the keys of each tile agree.

import package::gen::{SortParams, SORT_THREADS, SORT_ITEMS, SORT_TILE};
import package::passes::sort::agreement::{NO_KEYS, merge, merge_over_workgroup};

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read> keys: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> sort_agreements: array<vec4<u32>>;

@compute @workgroup_size(SORT_THREADS)
fn agree(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let tile = group.x + group.y * groups.x;
    if tile >= params.tiles {
        return;
    }
    var own = NO_KEYS;
    for (var item = 0u; item < SORT_ITEMS; item++) {
        // The last key stands in for those beyond the end: it changes no agreement that holds it.
        let index = min(tile * SORT_TILE + item * SORT_THREADS + thread, params.count - 1u);
        let key = keys[index];
        own = merge(own, vec4<u32>(key, key));
    }
    let all = merge_over_workgroup(own, thread);
    if thread == 0u {
        sort_agreements[tile] = all;
    }
}
