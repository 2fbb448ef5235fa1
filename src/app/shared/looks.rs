//! After how many samples a film is looked at that is traced until its error is small enough. They follow from nothing else, so that such
//! a film is the same to the bit in every run.

/// Samples a pixel of such a film, at most.
pub const MOST_SPP: u32 = 1 << 20;

/// Where the next look is: 4, 6, 8, 12, 16, 24, ..
pub fn next_look(spp: u32) -> u32 {
    if spp.is_power_of_two() { spp / 2 * 3 } else { spp / 3 * 4 }
}
