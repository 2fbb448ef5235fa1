//! RON with places: a tree whose every value knows where it was written, and readers that turn it into typed data.
//!
//! The `ron` crate reads the syntax, level by level through its raw values; what we add is that a wrong value, an unknown
//! field or a number out of range is reported where it stands, with its field path, and that defines can change the
//! tree before it is typed. (`ron::Value` forgets both places and the names of variants.)

mod defines;
mod fields;
mod tree;
mod values;

pub use defines::{apply_defines, define_texts};
pub use fields::{Fields, Reader};
pub use tree::{Kind, Node, parse};
