//! The twin of every pass on the CPU, by the same names; f64 where it is an oracle.

pub mod bsdf;
pub mod display;
pub mod film;
pub mod intersect;
pub mod metrics;
pub mod morton;
pub mod path;
pub mod rng;
pub mod sort;
pub mod traverse;
pub mod tree;
pub mod tree_check;
pub mod triangles;
