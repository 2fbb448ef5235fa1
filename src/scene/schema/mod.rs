//! JSON schemas of scene and variant files, made of the tables that their readers go by, and files as such JSON.
//!
//! RON as JSON: structs and maps are objects, tuples and lists arrays, words strings, `Name(..)` an object of that one key, and
//! `None` is null.

mod document;
mod parts;
mod scene;
mod values;
mod variants;

pub use document::document;
pub use scene::scene;
pub use variants::variants;
