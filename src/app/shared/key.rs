//! Numbers that stand for all that something depends on.

use std::fmt::{self, Write};

use crate::components::{Adaptive, Integrator, Render, Reuse, Sampler, Tone};
use crate::scene::SceneDescription;

/// Fowler, Noll and Vo's hash FNV-1a, 64 bits: the same on every machine and by every compiler.
struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        Ok(())
    }
}

/// Of anything, by what it looks like to those who debug.
pub fn hash(of: impl fmt::Debug) -> u64 {
    let mut fnv = Fnv::new();
    write!(fnv, "{of:?}").expect("invariant: a hash takes any text");
    fnv.0
}

/// Of the picture that every unbiased estimate of a scene tends to: all of the description but its name, how it is shown,
/// and how light is estimated.
pub fn scene_key(description: &SceneDescription) -> String {
    let mut plain = description.clone();
    plain.name.clear();
    (plain.film.exposure, plain.film.tone) = (0.0, Tone::None);
    let (integrator, sampler) = (Integrator::Path, Sampler::Pcg);
    let (reuse, adaptive) = (Reuse::Off, Adaptive::Off);
    plain.render = Render { integrator, sampler, roulette: false, reuse, adaptive, seed: 0, spp: 1, ..plain.render };
    // Numbers are written so that they read back to the same bits.
    format!("{:016x}", hash(plain))
}
