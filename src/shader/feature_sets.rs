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
        let chosen =
            |set: u64| (0..named.len()).filter(|bit| set >> bit & 1 == 1).map(|bit| named[bit].clone()).collect();
        Ok(sets_of(named.len()).into_iter().map(chosen).collect())
    }
}

/// The sets of so many features, a bit each, in ascending order.
fn sets_of(count: usize) -> Vec<u64> {
    if count <= MOST_NAMED {
        return (0..1 << count).collect();
    }
    let all = (1 << count) - 1;
    let pairs = (0..count).flat_map(|a| (0..a).map(move |b| 1 << a | 1 << b));
    let others = (0..count).flat_map(|bit| [1 << bit, all ^ (1 << bit)]);
    let mut sets: Vec<u64> = [0, all].into_iter().chain(pairs).chain(others).collect();
    sets.sort_unstable();
    sets
}
