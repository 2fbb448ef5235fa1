//! What several rows measure with.

pub mod aimed;
pub mod batch;
pub mod edits;
pub mod films;
pub mod forest;
pub mod lamps;
pub mod lookups;
pub mod paths;
pub mod placed;
pub mod plant;
pub mod quadrature;
pub mod sums;
pub mod surface;
pub mod tracer;
pub mod trees;
