//! What the tests share.

pub mod trees;
