// Decides which digits are sorted, from where to where, and how many workgroups that takes. One workgroup.

import package::gen::{SortParams, SortPlan, SORT_THREADS, SORT_DIGITS, SORT_BINS, SORT_MOST_GROUPS, SORT_FEW_TILES};
import package::gen::{SORT_IN_FRONT, SORT_IN_BACK};
import package::passes::sort::agreement::{NO_KEYS, merge, merge_over_workgroup};
import package::passes::sort::digit::digit_of;

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read> sort_agreements: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> sort_plan: SortPlan;

@compute @workgroup_size(SORT_THREADS)
fn plan(@builtin(local_invocation_index) thread: u32) {
    var own = NO_KEYS;
    for (var tile = thread; tile < params.tiles; tile += SORT_THREADS) {
        own = merge(own, sort_agreements[tile]);
    }
    let all = merge_over_workgroup(own, thread);
    if thread != 0u {
        return;
    }
    // A bit differs where some key has it and not all have it.
    let differ = all.zw & ~all.xy;
    let rows = (params.tiles + SORT_MOST_GROUPS - 1u) / SORT_MOST_GROUPS;
    let few = params.tiles <= SORT_FEW_TILES;
    let scan_groups = select(SORT_BINS, SORT_BINS * SORT_FEW_TILES / SORT_THREADS, few);
    var source = SORT_IN_FRONT;
    var run = 0u;
    for (var digit = 0u; digit < SORT_DIGITS; digit++) {
        let wanted = digit_of(differ, digit) != 0u;
        let on = select(0u, 1u, wanted);
        sort_plan.digits[digit].tiles_x = on * min(params.tiles, SORT_MOST_GROUPS);
        sort_plan.digits[digit].tiles_y = on * rows;
        sort_plan.digits[digit].tiles_z = on;
        sort_plan.digits[digit].source = source;
        sort_plan.digits[digit].bins_x = on * scan_groups;
        sort_plan.digits[digit].bins_y = on;
        sort_plan.digits[digit].bins_z = on;
        sort_plan.digits[digit].skipped = 1u - on;
        run += on;
        source = select(source, SORT_IN_FRONT + SORT_IN_BACK - source, wanted);
    }
    sort_plan.result = source;
    sort_plan.digits_run = run;
}
