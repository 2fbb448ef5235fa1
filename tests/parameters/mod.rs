//! Parameters that shaders declare: read by the linker, set by scenes and commands.

mod commands;
mod declared;
mod linked;
