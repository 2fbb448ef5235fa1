//! The twin of every pass on the CPU, by the same names; f64 where it is an oracle.

pub mod intersect;
pub mod morton;
pub mod sort;
pub mod traverse;
pub mod tree;
pub mod tree_check;
