//! Parameters of the clear pass.

gpu_struct! {
    /// Parameters of the clear pass.
    pub struct ClearParams {
        /// Words to write, from the start of the buffer.
        pub count: u32,
        /// What each of them becomes.
        pub value: u32,
    }
}
