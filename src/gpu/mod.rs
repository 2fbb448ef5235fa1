//! Device, buffers, pipelines, the player of recordings, and a window's surface: the only code that talks to wgpu.

mod buffers;
mod code;
mod compiler;
mod device;
mod entry;
mod error;
mod memory;
mod picture;
mod pipeline;
mod pipeline_cache;
mod pipelines;
mod player;
mod room;
mod rounding;
mod runtime;
mod surface;
mod table;
mod timing;

pub use buffers::Buffers;
pub use code::{Code, Values};
pub use compiler::{Compiler, PassCompile};
pub use device::{AdapterSummary, Gpu, adapters};
pub use entry::{checked_entry, features_of};
pub use error::GpuError;
pub use memory::{DeviceMemory, Held};
pub use picture::{Fit, Placement};
pub use rounding::HALVES;
pub use runtime::Runtime;
pub use surface::{Drawn, Paint, Surface, Target};
pub use table::{GpuTable, TableRow};
pub use timing::PassTiming;
