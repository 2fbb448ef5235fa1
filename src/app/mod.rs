//! The drivers of the schedule: command line now, window later.

pub mod bench;
