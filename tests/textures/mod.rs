//! Textures: lookups, and pictures with them.

mod board;
mod leaves;
mod lookups;
mod oracle;
