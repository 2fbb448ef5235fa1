//! The one test crate: linking wgpu once is quick, twenty times is not. A module a pass or a layer.

mod extend;
mod engine;
mod intersect;
mod law;
mod layout;
mod morton;
mod passes;
mod path;
mod player;
mod save;
mod scene;
mod shader;
mod shader_errors;
mod shader_fuzz;
mod sort;
mod support;
mod tree;
