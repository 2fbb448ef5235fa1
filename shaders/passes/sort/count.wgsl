// Histogram of one digit over each tile.

import package::gen::{SortParams, SortPlan, SORT_THREADS, SORT_ITEMS, SORT_TILE, SORT_BINS, SORT_IN_FRONT};
import package::passes::sort::digit::digit_of;
@if(sort_census) import package::passes::sort::digit::take_census;

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read> sort_plan: SortPlan;
@group(0) @binding(2) var<storage, read> keys: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> keys_back: array<vec2<u32>>;
/// Bin by bin, and tile by tile in a bin.
@group(0) @binding(4) var<storage, read_write> sort_counts: array<u32>;

var<workgroup> bins: array<atomic<u32>, SORT_BINS>;

@compute @workgroup_size(SORT_THREADS)
fn count(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let tile = group.x + group.y * groups.x;
    if tile >= params.tiles {
        return;
    }
    @if(sort_census) take_census(params.digit, 0u, thread);
    atomicStore(&bins[thread], 0u);

    // All loads before all else, and without a branch around any, so that they are in flight together.
    let first = tile * SORT_TILE + thread;
    let last = params.count - 1u;
    var held: array<vec2<u32>, SORT_ITEMS>;
    if sort_plan.digits[params.digit].source == SORT_IN_FRONT {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            held[item] = keys[min(first + item * SORT_THREADS, last)];
        }
    } else {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            held[item] = keys_back[min(first + item * SORT_THREADS, last)];
        }
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        if first + item * SORT_THREADS <= last {
            atomicAdd(&bins[digit_of(held[item], params.digit)], 1u);
        }
    }
    workgroupBarrier();
    sort_counts[thread * params.tiles + tile] = atomicLoad(&bins[thread]);
}
