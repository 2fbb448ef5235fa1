//! Components to the records and parameters that the device reads: pure functions, which know components and layout alone.

pub mod camera;
pub mod lighting;
pub mod material;
