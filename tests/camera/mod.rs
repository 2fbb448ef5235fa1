//! Lenses: their disk, their rays on the GPU, in the twin and in the oracle, and their fields in scene files.

mod disk;
mod edge;
mod fields;
mod kernel;
mod panel;
