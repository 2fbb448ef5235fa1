//! The tree over triangles: how it is built, what it takes, and how it is judged.
//!
//! A builder is a file here that fills in a [`Plan`]; [`PLAN`] is the one in use.

pub mod lbvh;
mod plan;
pub mod pyramid;

pub use plan::Plan;

/// The builder in use.
pub static PLAN: &Plan = &lbvh::PLAN;
