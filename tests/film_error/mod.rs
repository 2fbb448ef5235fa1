//! What a film tells of its own error: by its definition pixel by pixel, of model films whose error is known, and of scenes.

mod definition;
mod model;
mod models;
mod scenes;
mod slivers;
mod stopping;
