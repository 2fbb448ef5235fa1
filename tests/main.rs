//! The one test crate: linking wgpu once is quick, twenty times is not. A module a pass or a layer.

mod bsdf;
mod cli;
mod display;
mod edits;
mod engine;
mod extend;
mod film;
mod intersect;
mod law;
mod layout;
mod morton;
mod passes;
mod path;
mod player;
mod rooms;
mod save;
mod scene;
mod shader;
mod shader_errors;
mod shader_fuzz;
mod sort;
mod statistics;
mod support;
mod tree;
