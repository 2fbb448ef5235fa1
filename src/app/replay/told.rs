//! A path, as it is told.

use super::third::Third;
use crate::engine::Replay;
use crate::scene::SceneDescription;

/// All that is known of a path.
pub struct Told<'a> {
    pub replay: &'a Replay,
    /// What the oracle says of each of its rays.
    pub third: &'a [Option<Third>],
    /// As it was replayed.
    pub description: &'a SceneDescription,
    pub adapter: &'a str,
    /// The command line that gives the same again.
    pub repeat: &'a str,
}
