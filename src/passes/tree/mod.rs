//! The tree over triangles: how it is built, what that needs, and how it is judged.
//!
//! A builder is a file here that fills in a [`Plan`] and lists its passes in [`PASSES`]; [`PLAN`] is the one in use.

pub mod lbvh;
mod plan;
pub mod pyramid;
pub mod treelets;

pub use plan::Plan;

use super::Pass;

/// The builder in use.
pub static PLAN: &Plan = &lbvh::PLAN;

/// The passes of every builder.
pub const PASSES: &[&Pass] =
    &[&lbvh::BOUNDS, &lbvh::MORTON, &lbvh::LEAVES, &lbvh::PYRAMID, &lbvh::NODES, &treelets::TREELETS, &treelets::TOPS];
