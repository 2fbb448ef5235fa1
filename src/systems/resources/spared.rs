//! What was not done for the film: it was there already, or nothing needs it.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

/// What had been done, since the engine opened, when the film that there is began.
#[derive(Resource, Default, Clone, Debug, PartialEq)]
pub struct DoneBefore {
    /// Bytes sent to each buffer.
    pub uploads: BTreeMap<&'static str, u64>,
    /// Dispatches by pass.
    pub dispatches: BTreeMap<&'static str, u64>,
    /// Seconds of building trees.
    pub build: f64,
}

/// What was not done for the film that there is, because it was there already or nothing needs it. Bytes are those that would have been sent, and
/// milliseconds those that it took when it was last done: what was never measured is not told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spared {
    /// Textures that no mesh uses, and what they would take on the device.
    pub unused_textures: u32,
    pub unused_texture_bytes: u64,
    /// What textures that are used would take beyond what they do, without being halved.
    pub halved_texture_bytes: u64,
    /// Bytes of the scene's arrays that were not sent, by buffer; those of which something was not.
    pub uploads: BTreeMap<&'static str, u64>,
    /// Passes that ran before and not for this film, with the milliseconds of the last recording that they ran in; none where that was not timed.
    pub passes: Vec<(&'static str, Option<f64>)>,
    /// Milliseconds of building the tree that there is; none where it was built for this film.
    pub build_milliseconds: Option<f64>,
}

impl Spared {
    /// Bytes of all uploads.
    pub fn upload_bytes(&self) -> u64 {
        self.uploads.values().sum()
    }

    /// Milliseconds of all passes that were timed.
    pub fn pass_milliseconds(&self) -> f64 {
        self.passes.iter().filter_map(|(_, milliseconds)| *milliseconds).sum()
    }
}
