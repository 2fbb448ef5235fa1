//! Components to the records and parameters that the device reads: pure functions, which know components and layout alone.

pub mod camera;
pub mod cdf;
pub mod daylight;
pub mod light;
pub mod lighting;
pub mod material;
pub mod point;
pub mod sky;
pub mod sky_size;
pub mod sun;
pub mod texture;
pub mod uvs;
