//! The pass table and the recording of dispatches. Does not know wgpu.
//!
//! A pass is one row: a name, a WGSL entry point and its bindings by name. A stage's file holds its rows, the buffers they
//! need, and the functions that record them. [`table::TABLE`] lists every row.

pub mod adaptive;
pub mod blocks;
mod clear;
pub mod debug;
pub mod extend;
pub mod features;
pub mod film;
pub mod lattice;
pub mod lint;
mod pass;
pub mod probe;
mod recording;
pub mod replay;
pub mod sort;
pub mod sources;
pub mod table;
mod textures;
pub mod trace;
pub mod tree;
mod twin;
pub mod view;

pub use clear::{CLEAR, clear};
pub use pass::{Access, Binding, Makes, Pass};
pub use recording::{Call, Recording, Size};
pub use twin::Twin;
