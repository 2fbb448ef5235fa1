//! One file a phase of the schedule.
