//! Textures: their words, their lookups, and the pictures that come of them.

mod garden;
mod look;
mod twin;
