//! From what a material says of its maps to textures.
//!
//! Each file is decoded once, whatever maps name it, and not at all where it was decoded for a scene that still has it
//! ([`cache`]). A map that can't be read is a warning, and its material has none.

mod budget;
mod cache;
mod decode;
mod load;
mod name;
mod picture;
mod reading;
mod relief;

pub use load::{Loading, load};
pub use name::{MapUse, name};
pub use picture::{Picture, Reduction};
