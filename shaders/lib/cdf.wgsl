// Drawing an index by weights, by the sums of the weights up to each: numbers in order give indices in order, and what is left of a number is even
// over its index. So draws by an evenly spread sequence are evenly spread, which an alias table would tear to pieces.
//
// Tables lie in buffers, which no function can be given: the search is written where they are (passes/trace/connect, passes/trace/sky), alike.
//
// A table keeps besides where to begin the search (the cutpoint method: Chen and Asau, On Generating Random Variates from an Empirical
// Distribution, 1974): [0, 1) is cut into buckets, and of each the first index that a number in it may be for is known.

import package::gen::{HALF_STEP};

// How many buckets a table of `count` entries has: a power of two, so that the bucket of a number is found without rounding.
fn count_buckets(count: u32) -> u32 {
    return 1u << firstLeadingBit(count);
}

fn bucket_of(u: f32, count: u32) -> u32 {
    let buckets = count_buckets(count);
    return min(u32(u * f32(buckets)), buckets - 1u);
}

// What is left of a uniform number of an entry, in [0, 1): numbers stand for the middle of their steps.
fn left_over(u: f32, start: f32, end: f32) -> f32 {
    return min((u - start + HALF_STEP) / (end - start), 0x1.fffffep-1);
}

// A uniform number from `start` to `end`, stretched to [0, 1), to be used for more: of all numbers it is the same one.
fn stretched(u: f32, start: f32, end: f32) -> f32 {
    return min((u - start) / (end - start), 0x1.fffffep-1);
}
