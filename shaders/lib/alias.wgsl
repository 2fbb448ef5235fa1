// Drawing from an alias table, whose columns the caller keeps.

import package::gen::{HALF_STEP};

struct AliasPick {
    column: u32,
    // Below the column's threshold it stands for itself. Below 1.
    rest: f32,
}

// The column of `count` that a uniform number of 24 bits is in. It stands for the middle of its step: taken as the step's lower end,
// every share below that of its column would be rounded up, and what is bright would pay for all of them.
fn alias_pick(u: f32, count: u32) -> AliasPick {
    let scaled = u * f32(count);
    let column = min(u32(scaled), count - 1u);
    // Rounding can reach the next column.
    return AliasPick(column, min(scaled - f32(column) + f32(count) * HALF_STEP, 0x1.fffffep-1));
}
