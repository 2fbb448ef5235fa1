//! How many samples each tile of an adaptive film gets: a function of what its halves have told.
//!
//! # Why the mean is right
//!
//! Kirk and Arvo (Unbiased sampling techniques for image synthesis, 1991) show that a mean is biased where the number of its samples depends on
//! their values: a pixel that looks quiet by chance is left as it is. They draw the number by samples that are thrown away after. Here none is, for
//! each half of the film does that for the other (two halves are also what Dammertz et al. 2010 tell a picture's error by, and stop at it, with the
//! bias). Let a be all random numbers of half A, b those of half B, traced or not. Halves are scrambled apart, so a and b are independent. If the
//! numbers of samples of all tiles of A are a function of b alone, then given b they are fixed, and the mean of A's samples of a pixel has the pixel's
//! radiance as its mean, whatever b is. The same of B. So the picture is the mean of both means. Not the sum of all samples by their number: that weighs A
//! by the number of B, which is of a's making.
//!
//! Rounds are where this is easily lost. B's numbers are a function of a; what B tells in a later round is of samples that it has only as a says; and if
//! A heeds that, its numbers depend on a. So what is heeded of a half are the first samples of each pixel, as many as every tile has whatever was
//! decided, and this number is fixed by the round: all of those are functions of b alone. It is what the [`share`] is for that every tile gets, besides that a
//! tile that was quiet by luck is not starved. That a half has more to tell is not used.
//!
//! The rounds, for a half of which a pixel has n samples on average:
//!
//! | n | samples of the other half that are heeded | least samples |
//! |---|---|---|
//! | up to 8 | none: all tiles have n | n |
//! | up to 128 | the first 8 | 8, or n / 8 |
//! | up to 256, 512, .. | the first 16, 32, .. | n / 8 |
//!
//! Where a film ends is for who looks at it: a film that stops by its error heeds both halves, adaptive or not.
//!
//! Halves that heed each other are not quite independent: where variance comes with radiance, as it does, both halves' errors go the same way by the product
//! of two such dependencies. It is of second order, and what a film tells of its error ([`film_error`](crate::cpu::film_error)) is too small by as much.

mod counts;
mod grid;
mod weights;

pub use counts::Plan;
pub use grid::Grid;
pub use weights::weights;

/// Samples of each half that all tiles get before anything is chosen.
pub const PILOT: u32 = 8;

/// Every tile gets the average number of samples by this, at least.
const SHARE: u32 = 8;

/// Samples of a half that every tile has, where a pixel has `average` of them on average.
pub fn share(average: u32) -> u32 {
    (average / SHARE).max(PILOT.min(average))
}

/// The round in which a pixel of a half comes to have `average` samples on average; more than [`PILOT`].
pub fn round_of(average: u32) -> u32 {
    (average.max(1) - 1).checked_div(PILOT * SHARE).and_then(u32::checked_ilog2).unwrap_or(0)
}

/// The average at which a round ends.
pub fn end_of(round: u32) -> u32 {
    (PILOT * SHARE).saturating_mul(2u32.saturating_pow(round + 1))
}

/// Samples of the other half that are heeded in a round.
pub fn heeded(round: u32) -> u32 {
    PILOT.saturating_mul(2u32.saturating_pow(round))
}

/// Where the samples of half a tile end that are to be told next: at half of what is heeded first, and whenever there are twice as many. `count` are
/// those that it has.
pub fn next_tally(count: u32) -> u32 {
    let mut end = PILOT / 2;
    while end <= count {
        end = end.saturating_mul(2);
    }
    end
}
