// Digits of a key, and a census of workgroups for the tests.

/// Bits [8 * digit, 8 * digit + 8) of a key (low word, high word).
fn digit_of(key: vec2<u32>, digit: u32) -> u32 {
    let word = select(key.x, key.y, digit >= 4u);
    return (word >> ((digit & 3u) * 8u)) & 255u;
}

/// Workgroups that ran, by digit and then by stage: 0 count, 1 scan, 2 scatter.
@if(sort_census) @group(0) @binding(10) var<storage, read_write> sort_census: array<atomic<u32>>;

@if(sort_census)
fn take_census(digit: u32, stage: u32, thread: u32) {
    if thread == 0u {
        atomicAdd(&sort_census[digit * 3u + stage], 1u);
    }
}
