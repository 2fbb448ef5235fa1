//! What rows are measured on.

pub mod boxes;
pub mod clouds;
pub mod covered;
pub mod described;
pub mod lamp;
pub mod prism;
pub mod rays;
pub mod room;
pub mod smooth;
pub mod solids;
pub mod uneven;
