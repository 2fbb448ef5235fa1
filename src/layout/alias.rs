//! Alias tables: an index by given weights, from one uniform number and one look-up (Walker 1977; Vose 1991).

gpu_struct! {
    /// One column of an alias table.
    pub struct AliasColumn {
        /// The column stands for its own index where the remainder of the uniform number is below this, 0 to 1.
        pub threshold: f32,
        /// The index it stands for otherwise.
        pub other: u32,
    }
}

gpu_consts! {
    /// Half the step of the uniform numbers that choose a column, 2^-24.
    pub const HALF_STEP: f32 = 1.0 / (1 << 25) as f32;
}
