//! Device, buffers, pipelines and the player of recordings: the only engine code that talks to wgpu.

mod buffers;
mod device;
mod entry;
mod error;
mod pipelines;
mod player;
mod runtime;
mod timing;

pub use buffers::Buffers;
pub use device::{AdapterSummary, Gpu, adapters};
pub use entry::checked_entry;
pub use error::GpuError;
pub use pipelines::{Code, Compiler};
pub use runtime::Runtime;
pub use timing::PassTiming;
