//! Pictures in and out: one reader of EXR, Radiance HDR and PNG, one writer, and sRGB. Knows neither scenes nor the GPU.
//!
//! [`Source`] reads the pixels that a file has, or a part of them; [`Shown`] places them where the file says that they are
//! to be seen. [`Output`] writes a picture as the kind of file that its name says, and [`file`] makes any file appear whole.

mod error;
mod exr;
pub mod file;
mod hdr;
mod outputs;
mod pixel;
mod png;
mod source;
pub mod srgb;
mod tail;
mod write;

pub use error::{Fault, ReadError};
pub use file::SaveError;
pub use outputs::Outputs;
pub use pixel::Pixel;
pub use source::{Shown, Source};
pub use write::{Kind, Output, Picture};
