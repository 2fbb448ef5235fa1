//! Which sets of features a module is to be tried with.

use super::Features;
use super::error::ShaderError;
use super::library::Library;

/// Features of a module up to which every set of them is listed.
const MOST_NAMED: usize = 5;

impl Library {
    /// The sets of features that make a difference to a module: all of them, or where its closure's conditions name more
    /// than five, so many that every two features meet on and on, on and off, off and off: none, each by itself, each
    /// pair, all but one, and all.
    pub fn feature_sets(&self, module: &str) -> Result<Vec<Features>, ShaderError> {
        let named: Vec<String> = self.link(module, &self.features()?)?.features.into_iter().collect();
        let count = named.len();
        let listed = |set: &u64| {
            let on = set.count_ones() as usize;
            count <= MOST_NAMED || on <= 2 || on + 1 >= count
        };
        let chosen = |set: u64| (0..count).filter(|bit| set >> bit & 1 == 1).map(|bit| named[bit].clone()).collect();
        Ok((0..1 << count).filter(listed).map(chosen).collect())
    }
}
