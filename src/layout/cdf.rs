//! Tables that an index is drawn from by given weights: the sums of the weights, and where to begin the search in them.

gpu_struct! {
    /// An entry of such a table.
    pub struct CdfEntry {
        /// Sum of the weights up to this one, of all together: a multiple of 2^-24. The index is that of the first entry whose sum is above
        /// the uniform number.
        pub end: f32,
        /// The first index that a number of this bucket may be for. There are as many buckets as the largest power of two that the number
        /// of entries reaches.
        pub first: u32,
    }
}

gpu_consts! {
    /// Half the step of uniform numbers, 2^-24.
    pub const HALF_STEP: f32 = 1.0 / (1 << 25) as f32;
}
