//! The judge: its statistics simulated, and its verdicts on edited shaders.

mod commits;
mod edits;
mod simulated;
mod sizing;
mod table;
