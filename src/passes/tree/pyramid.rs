//! How the pyramid of boxes over sorted leaves lies in its buffer.

/// Boxes of the pyramid over `n` leaves, level 0 included.
pub fn pyramid_boxes(n: u32) -> u32 {
    levels(n).map(|(_, count)| count).sum()
}

/// First box and number of boxes of each level of the pyramid over `n` leaves, from the leaves up.
pub fn levels(n: u32) -> impl Iterator<Item = (u32, u32)> {
    std::iter::successors((n > 0).then_some((0, n)), |&(start, count)| {
        (count > 1).then_some((start + count, count / 2))
    })
}
