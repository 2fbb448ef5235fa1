//! What several commands share.

pub mod compiling;
pub(super) mod csv;
pub(super) mod describe;
pub(super) mod failure;
#[cfg(feature = "flip")]
pub(super) mod flip;
pub(super) mod interrupt;
pub(super) mod key;
pub mod memory;
pub(super) mod opening;
pub(super) mod output;
pub(super) mod parameters;
pub(super) mod pictures;
pub(super) mod plot;
pub mod progress;
pub mod quality;
pub mod scene;
pub(super) mod seconds;
pub(super) mod settings;
pub(super) mod shrink;
pub(super) mod sources;
pub mod spared;
pub mod spread;
pub mod textures;
pub(super) mod tracer;
pub(super) mod values;
