//! The judge: its statistics simulated, and its verdicts on edited shaders.

mod commits;
mod edits;
mod short;
mod simulated;
mod sizing;
mod table;
