//! One file a phase of the schedule.
pub mod save;
