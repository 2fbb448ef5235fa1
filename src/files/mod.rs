//! Files and folders as people, editors and other programs leave them: regular files alone are opened, links are followed, and
//! every walk has an end. Does not know what is in a file.

mod digest;
mod open;
mod relative;
mod stamp;
mod trail;
mod walk;

pub use digest::Digest;
pub use open::{NoFile, explained, open_regular, read, regular};
pub use relative::relative;
pub use stamp::Stamp;
pub use trail::trail;
pub use walk::{DEEPEST, Walk, walk};
