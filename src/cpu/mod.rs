//! The twin of every pass on the CPU, by the same names; f64 where it is an oracle. And what is said of pictures: metrics,
//! blocks, and whether an estimator became better, worse or wrong.

pub mod alias;
pub mod blocks;
pub mod bsdf;
pub mod connect;
pub mod display;
pub mod efficiency;
pub mod equal_means;
pub mod film;
pub mod intersect;
pub mod lint;
pub mod metrics;
pub mod morton;
pub mod oracle;
pub mod path;
pub mod rng;
pub mod rng_sobol;
pub mod sign_flips;
pub mod sky;
pub mod sort;
pub mod statistics;
pub mod traverse;
pub mod tree;
pub mod tree_check;
pub mod triangles;
pub mod view;
