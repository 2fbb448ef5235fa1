//! What must hold of the numbers, measured: a row is a statement, what is measured of it, and what that may be at most. The table is
//! what `lucerna stress` shows, and `cargo test` runs each row at its smallest size.
//!
//! A row goes through the doors that all else goes through: the engine, the passes over a scene that is loaded, their twins, the f64 path
//! tracer. It knows nothing of command lines, nor how its figures are shown.

mod lab;
mod measured;
mod outcome;
pub mod planted;
mod row;
pub mod rows;
pub mod scenes;
pub mod tools;

pub use lab::Lab;
pub use measured::{Measured, Scale, StressError};
pub use outcome::{Outcome, Verdict, judge};
pub use row::Row;
