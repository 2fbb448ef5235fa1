// Exclusive prefix sums over the threads of a workgroup (Hillis and Steele 1986), two counters at once.

import package::gen::SORT_THREADS;

/// Two pages: each step reads one and writes the other, so that a step takes one barrier.
var<workgroup> prefix_pages: array<vec2<u32>, 2u * SORT_THREADS>;

struct Prefix {
    /// Sum over the threads below this one.
    before: vec2<u32>,
    /// Sum over all threads.
    total: vec2<u32>,
}

/// Called by all threads of a workgroup, after a barrier since the call before.
fn prefix_over_workgroup(own: vec2<u32>, thread: u32) -> Prefix {
    var sum = own;
    var page = 0u;
    prefix_pages[thread] = sum;
    workgroupBarrier();
    for (var step = 1u; step < SORT_THREADS; step <<= 1u) {
        if thread >= step {
            sum += prefix_pages[page + thread - step];
        }
        page = SORT_THREADS - page;
        prefix_pages[page + thread] = sum;
        workgroupBarrier();
    }
    return Prefix(sum - own, prefix_pages[page + SORT_THREADS - 1u]);
}
