//! Asset files to entities, with located diagnostics. Does not know the GPU.

pub mod generate;
