//! Numbers that code shows of itself: which one is asked for, what is kept of them, and how they are coloured.

use glam::UVec3;

gpu_consts! {
    /// The type of a number that is shown.
    pub const PROBE_F32: u32 = 0;
    pub const PROBE_U32: u32 = 1;
    pub const PROBE_BOOL: u32 = 2;
    pub const PROBE_VEC2: u32 = 3;
    pub const PROBE_VEC3: u32 = 4;
    /// At whatever bounce it is shown first.
    pub const PROBE_FIRST: u32 = 0xffff_ffff;
    /// The number of no name.
    pub const NO_PROBE: u32 = 0xffff_ffff;
    /// Of vectors, their length, and not the channel of that number.
    pub const PROBE_LENGTH: u32 = 3;
    /// Names that the shaders of a library may have.
    pub const MOST_PROBES: u32 = 64;
    /// Numbers that are kept of a ray of a path that is replayed, and of all of its rays.
    pub const MOST_PROBED_OF_TURN: u32 = 64;
    pub const MOST_PROBED: u32 = 4096;
}

gpu_struct! {
    /// A number that was shown on the way of a path that is replayed.
    pub struct Probed {
        /// Bits of its channels; 0 of those that it lacks. A bool is 0 or 1.
        pub bits: UVec3,
        /// A `PROBE_` type.
        pub kind: u32,
        /// Number of its name.
        pub name: u32,
        /// Path segments before the one at whose end the path is.
        pub bounce: u32,
        /// Rays before the one that is being traced, or that was traced last.
        pub turn: u32,
        pub pad0: u32,
    }

    /// What is asked of each pixel's path.
    pub struct ProbeChoice {
        /// Number of the name; one that no name has where nothing is asked.
        pub name: u32,
        /// The bounce, of the first layer: each has one more; or `PROBE_FIRST`, of a single layer.
        pub bounce: u32,
        /// Of vectors, the channel that the range is of, or `PROBE_LENGTH`.
        pub part: u32,
        pub pad0: u32,
    }

    /// Parameters of the pass `probe colours`.
    pub struct ProbeColours {
        pub pixels: u32,
        /// Of vectors, a channel, or `PROBE_LENGTH`.
        pub part: u32,
        /// 1: colours are even in the logarithm.
        pub logarithmic: u32,
        /// 1: from `low` to `high`, and not from the least number to the greatest.
        pub bounded: u32,
        pub low: f32,
        /// At least `low`.
        pub high: f32,
        pub pad0: u32,
        pub pad1: u32,
    }
}
