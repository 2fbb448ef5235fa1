// Exclusive prefix sums of one digit's counts, tile by tile. The sums over bins are left to scatter.

import package::gen::{SortParams, SORT_THREADS, SORT_BINS, SORT_SCAN_ITEMS, SORT_FEW_TILES};
import package::passes::sort::prefix::prefix_over_workgroup;
@if(sort_census) import package::passes::sort::digit::take_census;

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read_write> sort_counts: array<u32>;
/// Digit by digit, and bin by bin in a digit.
@group(0) @binding(2) var<storage, read_write> sort_totals: array<u32>;

const CHUNK: u32 = SORT_THREADS * SORT_SCAN_ITEMS;

/// A chunk of counters, with a gap after each 32: threads that read runs of 8 then meet in no bank.
var<workgroup> chunk: array<u32, CHUNK + CHUNK / 32u>;

fn slot(index: u32) -> u32 {
    return index + index / 32u;
}

/// Any number of tiles: a workgroup a bin.
@compute @workgroup_size(SORT_THREADS)
fn scan(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    let bin = group.x;
    @if(sort_census) take_census(params.digit, 1u, thread);
    let row = bin * params.tiles;
    var carry = 0u;
    for (var start = 0u; start < params.tiles; start += CHUNK) {
        for (var item = 0u; item < SORT_SCAN_ITEMS; item++) {
            let index = item * SORT_THREADS + thread;
            var value = 0u;
            if start + index < params.tiles {
                value = sort_counts[row + start + index];
            }
            chunk[slot(index)] = value;
        }
        workgroupBarrier();
        var sum = 0u;
        for (var item = 0u; item < SORT_SCAN_ITEMS; item++) {
            sum += chunk[slot(thread * SORT_SCAN_ITEMS + item)];
        }
        let prefix = prefix_over_workgroup(vec2<u32>(sum, 0u), thread);
        var running = carry + prefix.before.x;
        for (var item = 0u; item < SORT_SCAN_ITEMS; item++) {
            let place = slot(thread * SORT_SCAN_ITEMS + item);
            let value = chunk[place];
            chunk[place] = running;
            running += value;
        }
        workgroupBarrier();
        for (var item = 0u; item < SORT_SCAN_ITEMS; item++) {
            let index = item * SORT_THREADS + thread;
            if start + index < params.tiles {
                sort_counts[row + start + index] = chunk[slot(index)];
            }
        }
        carry += prefix.total.x;
    }
    if thread == 0u {
        sort_totals[params.digit * SORT_BINS + bin] = carry;
    }
}

var<workgroup> few: array<u32, SORT_THREADS>;

/// At most SORT_FEW_TILES tiles: as many threads a bin, one a tile.
@compute @workgroup_size(SORT_THREADS)
fn scan_few(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    @if(sort_census) take_census(params.digit, 1u, thread);
    let tile = thread % SORT_FEW_TILES;
    let bin = (group.x * SORT_THREADS + thread) / SORT_FEW_TILES;
    let here = bin * params.tiles + tile;
    var own = 0u;
    if tile < params.tiles {
        own = sort_counts[here];
    }
    few[thread] = own;
    workgroupBarrier();
    var before = 0u;
    for (var i = 0u; i < params.tiles; i++) {
        let value = few[thread - tile + i];
        before += select(0u, value, i < tile);
    }
    if tile < params.tiles {
        sort_counts[here] = before;
    }
    if tile == params.tiles - 1u {
        sort_totals[params.digit * SORT_BINS + bin] = before + own;
    }
}
