//! Pictures in and out: one reader of EXR, Radiance HDR and PNG, one of textures, one writer, and sRGB. Knows neither scenes nor the
//! GPU.
//!
//! [`PictureFile`] reads the pixels that a file has, or a part of them; [`Shown`] places them where the file says that they are
//! to be seen. [`TextureFile`] reads the texels of these and of more kinds, as they are stored. [`Output`] writes a picture as the kind of file that its name says, [`Strips`] does so while its
//! rows are made, and [`file`] makes any file appear whole.

mod error;
mod exr;
pub mod file;
mod hdr;
mod outputs;
mod picture_file;
mod pixel;
mod png;
mod source;
pub mod srgb;
mod strips;
mod tail;
mod texels;
mod write;
mod write_exr;
mod write_png;

pub use error::{Fault, ReadError};
pub use file::SaveError;
pub use outputs::Outputs;
pub use picture_file::{PictureFile, Shown};
pub use pixel::Pixel;
pub use source::{Frame, Metadata};
pub use strips::{Rows, Strips};
pub use texels::{Alpha, Codes, ReadTexture, TextureFile, halve};
pub use write::{Kind, Output, Picture};
