//! Pictures as textures: texels as a file has them, codes undecoded, of every kind of file that models name.
//!
//! The size is known before a texel is read, and memory is for what the header declares: the texels, once, and a part of that again
//! for the decoder. Rows are from the top, as the file says they are to be seen; turns that EXIF tells of are not made.

mod decoder;
mod expand;
mod float;
mod halve;
mod jpeg;
mod read_texture;
mod texture_file;
mod tiff;

pub use halve::{Codes, halve};
pub use read_texture::{Alpha, ReadTexture};
pub use texture_file::TextureFile;
