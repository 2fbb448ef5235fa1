// Moves the pairs of each tile to their places by one digit, stably.
//
// A row of threads owns a run of consecutive keys, and ranks as many at a time. Where subgroups have 32 threads for certain (feature
// `ballots`), a row is one: a ballot a bit tells each thread which others have its digit, and the first of those counts them all.
// Nothing else waits (Adinets and Merrill 2022, "warp-level multi-split").
// Elsewhere a row is 16 threads: each thread raises its bit in the word
// of (row, digit), and then counts the bits below its own. The word's low half counts the keys that the row has ranked
// before, so one load tells a key its rank in the row (Onesweep's match by atomic OR; Adinolfi 2022, Adinets and Merrill 2022).
// The tile is then reordered in workgroup memory, so that neighbouring threads write neighbouring pairs.
//
// It is one long function so that its arrays are local variables with constant bounds: registers, once loops are unrolled.

import package::gen::{SortParams, SortPlan, SORT_THREADS, SORT_ITEMS, SORT_TILE, SORT_BINS, SORT_IN_FRONT};
@if(!ballots) import package::gen::{SORT_LANES};
@if(ballots) import package::gen::{SORT_BITS};
import package::passes::sort::digit::digit_of;
import package::passes::sort::prefix::prefix_over_workgroup;
@if(sort_census) import package::passes::sort::digit::take_census;

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read> sort_plan: SortPlan;
@group(0) @binding(2) var<storage, read> sort_counts: array<u32>;
@group(0) @binding(3) var<storage, read> sort_totals: array<u32>;
@group(0) @binding(4) var<storage, read_write> keys: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> payload: array<u32>;
@group(0) @binding(6) var<storage, read_write> keys_back: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read_write> payload_back: array<u32>;

/// Threads of a row.
@if(ballots) const LANES: u32 = 32u;
@if(!ballots) const LANES: u32 = SORT_LANES;

const ROWS: u32 = SORT_THREADS / LANES;

/// While ranking, bins of (row, digit): the count, in the low half where the high half is a mask. Then the tile's words in
/// their new order. One array, since both would not fit into 32 KiB.
var<workgroup> words: array<atomic<u32>, SORT_TILE>;

/// For each digit: add a pair's place in the reordered tile, and this is its place in the result.
var<workgroup> targets: array<u32, SORT_BINS>;

@compute @workgroup_size(SORT_THREADS)
fn scatter(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
    @if(ballots) @builtin(subgroup_id) row: u32,
    @if(ballots) @builtin(subgroup_invocation_id) lane: u32,
) {
    let tile = group.x + group.y * groups.x;
    if tile >= params.tiles {
        return;
    }
    @if(sort_census) take_census(params.digit, 2u, thread);
    let from_front = sort_plan.digits[params.digit].source == SORT_IN_FRONT;
    let high = params.digit >= 4u;
    @if(!ballots) let lane = thread % LANES;
    @if(!ballots) let row = thread / LANES;
    let first = tile * SORT_TILE + row * LANES * SORT_ITEMS + lane;
    let last = params.count - 1u;

    // Thread t is also in charge of bin t.
    let in_tiles_before = sort_counts[thread * params.tiles + tile];
    let in_all = sort_totals[params.digit * SORT_BINS + thread];
    var held: array<vec2<u32>, SORT_ITEMS>;
    if from_front {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            held[item] = keys[min(first + item * LANES, last)];
        }
    } else {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            held[item] = keys_back[min(first + item * LANES, last)];
        }
    }
    for (var item = 0u; item < SORT_ITEMS; item++) {
        atomicStore(&words[item * SORT_THREADS + thread], 0u);
        // What lies beyond the end takes the last digit, and as it comes last anyway, it moves no pair.
        if first + item * LANES > last {
            held[item] = vec2<u32>(0xffffffffu);
        }
    }
    workgroupBarrier();

    // Rank each key among the equal digits of its row.
    var rank: array<u32, SORT_ITEMS>;
    var bin = row * SORT_BINS;
    @if(ballots) {
        let lower = (1u << lane) - 1u;
        for (var item = 0u; item < SORT_ITEMS; item++) {
            let digit = digit_of(held[item], params.digit);
            var equal = 0xffffffffu;
            for (var place = 0u; place < SORT_BITS; place++) {
                let raised = ((digit >> place) & 1u) != 0u;
                let all = subgroupBallot(raised).x;
                equal &= select(~all, all, raised);
            }
            // What the row has counted before is in the bin by now: the last shuffle waited for it.
            let leader = firstTrailingBit(equal);
            bin = row * SORT_BINS + digit;
            var before = 0u;
            if lane == leader {
                before = atomicAdd(&words[bin], countOneBits(equal));
            }
            rank[item] = subgroupShuffle(before, leader) + countOneBits(equal & lower);
        }
    } @else {
        let bit = 0x10000u << lane;
        let below = bit - 0x10000u;
        for (var item = 0u; item < SORT_ITEMS; item++) {
            bin = row * SORT_BINS + digit_of(held[item], params.digit);
            atomicOr(&words[bin], bit);
            workgroupBarrier();
            let word = atomicLoad(&words[bin]);
            rank[item] = (word & 0xffffu) + countOneBits(word & below);
            workgroupBarrier();
            // Lower the bit and count the key. Other rows' and lanes' changes to this word touch other bits or add to the
            // same count; this lane's next bit follows in program order.
            atomicAdd(&words[bin], 1u - bit);
        }
    }
    workgroupBarrier();

    // Turn the counts into the first place of (digit, row) in the reordered tile.
    var in_tile = 0u;
    for (var r = 0u; r < ROWS; r++) {
        in_tile += atomicLoad(&words[r * SORT_BINS + thread]);
    }
    let prefix = prefix_over_workgroup(vec2<u32>(in_tile, in_all), thread);
    targets[thread] = prefix.before.y + in_tiles_before - prefix.before.x;
    var place = prefix.before.x;
    for (var r = 0u; r < ROWS; r++) {
        let here = r * SORT_BINS + thread;
        let number = atomicLoad(&words[here]);
        atomicStore(&words[here], place);
        place += number;
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        rank[item] += atomicLoad(&words[row * SORT_BINS + digit_of(held[item], params.digit)]);
    }
    workgroupBarrier();

    // Reorder the word that holds the digit, then the other one, then the payload.
    var goal: array<u32, SORT_ITEMS>;
    var sorted: array<u32, SORT_ITEMS>;
    for (var item = 0u; item < SORT_ITEMS; item++) {
        atomicStore(&words[rank[item]], select(held[item].x, held[item].y, high));
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        let here = item * SORT_THREADS + thread;
        let word = atomicLoad(&words[here]);
        sorted[item] = word;
        goal[item] = targets[digit_of(vec2<u32>(word), params.digit)] + here;
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        atomicStore(&words[rank[item]], select(held[item].y, held[item].x, high));
    }
    // Loaded here, so that the payload is on its way while the keys are written.
    var carried: array<u32, SORT_ITEMS>;
    if from_front {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            carried[item] = payload[min(first + item * LANES, last)];
        }
    } else {
        for (var item = 0u; item < SORT_ITEMS; item++) {
            carried[item] = payload_back[min(first + item * LANES, last)];
        }
    }
    workgroupBarrier();
    let filled = min(SORT_TILE, params.count - tile * SORT_TILE);
    for (var item = 0u; item < SORT_ITEMS; item++) {
        let here = item * SORT_THREADS + thread;
        let other = atomicLoad(&words[here]);
        let key = select(vec2<u32>(sorted[item], other), vec2<u32>(other, sorted[item]), high);
        if here < filled {
            if from_front {
                keys_back[goal[item]] = key;
            } else {
                keys[goal[item]] = key;
            }
        }
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        atomicStore(&words[rank[item]], carried[item]);
    }
    workgroupBarrier();
    for (var item = 0u; item < SORT_ITEMS; item++) {
        let here = item * SORT_THREADS + thread;
        let value = atomicLoad(&words[here]);
        if here < filled {
            if from_front {
                payload_back[goal[item]] = value;
            } else {
                payload[goal[item]] = value;
            }
        }
    }
}
