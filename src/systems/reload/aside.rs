//! Where the film and its counters are put aside while other code is on trial.

use crate::gpu::Runtime;

/// The buffers, and those that hold their copies. There are blocks only where a robust mean is wanted.
const ASIDE: [(&str, &str); 3] = [("film", "film_aside"), ("counters", "counters_aside"), ("blocks", "blocks_aside")];

/// Puts the film aside. False where there is no room for it.
pub fn put_aside(device: &mut Runtime) -> bool {
    ASIDE.iter().all(|(from, to)| device.copy(from, to).is_ok())
}

/// Brings the film back that was put aside. False where that can't be done.
pub fn bring_back(device: &mut Runtime) -> bool {
    ASIDE.iter().all(|(from, to)| device.copy(to, from).is_ok())
}
