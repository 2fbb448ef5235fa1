//! After how many samples a film is looked at that is traced until its error is small enough.
//!
//! Numbers of samples follow from what the film told at the looks before, and from nothing else, so such a film is the same to the bit in every
//! run. Looking often is no way to be lucky: looks are few until the goal is near, and those near it see nearly the same samples
//! (`tests/film_error/stopping.rs`).

/// Samples a pixel at the first look.
pub const FIRST_LOOK: u32 = 4;

/// Samples a pixel of such a film, at most.
pub const MOST_SPP: u32 = 1 << 20;

/// Looks between one power of two and the next, at most.
const LOOKS_AN_OCTAVE: u32 = 16;

/// A film's error falls at least like 1 / samples, where these are spread evenly by up to this power.
const STEEPEST: f64 = 1.25;

/// Samples a pixel at the next look. `times` is by how much the film's error is still too large: above 1.
///
/// As many as are needed if the error falls at its steepest, up to twice as many as there are.
pub fn next_look(spp: u32, times: f64) -> u32 {
    let needed = f64::from(spp) * times.powf(1.0 / STEEPEST).min(2.0);
    let step = 2.max((1 << spp.max(1).ilog2()) / LOOKS_AN_OCTAVE);
    let next = (needed / f64::from(step)).floor() as u32 * step;
    next.max((spp / step + 1) * step)
}
