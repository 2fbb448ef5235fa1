//! Textures: lookups, and pictures with them.

mod board;
mod lookups;
mod oracle;
