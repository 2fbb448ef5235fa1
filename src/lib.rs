//! Lucerna: a GPU path tracer.
//!
//! The crate is a data-oriented engine. A scene is entities and [`components`]; [`systems`] turn what changed into
//! recordings of compute [`passes`], and [`gpu`] plays them. ARCHITECTURE.md has the map and the way of one frame.

#[macro_use]
pub mod layout;
pub mod app;
pub mod components;
pub mod cpu;
pub mod engine;
pub mod files;
pub mod gpu;
pub mod image;
pub mod oracle;
pub mod parallel;
pub mod passes;
pub mod prepare;
pub mod process;
pub mod scene;
pub mod shader;
pub mod stats;
pub mod stress;
pub mod systems;
pub mod watch;

pub use engine::{Engine, EngineError, FilmImage, Progress, Report};
