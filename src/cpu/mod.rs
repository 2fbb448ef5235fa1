//! The twin of every pass on the CPU, by the same names; f64 where rounding would hide a mistake.

pub mod alias;
pub mod bounds;
pub mod bsdf;
pub mod camera;
pub mod connect;
pub mod display;
pub mod film;
pub mod intersect;
pub mod lint;
pub mod morton;
pub mod normals;
pub mod path;
pub mod pcg4d;
pub mod point;
pub mod rng;
pub mod rng_sobol;
pub mod sky;
pub mod sort;
pub mod sun;
pub mod texture;
pub mod textured;
pub mod traverse;
pub mod tree;
pub mod tree_check;
pub mod triangles;
pub mod view;
